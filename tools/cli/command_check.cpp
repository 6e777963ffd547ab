// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "radar/waveform/figures_of_merit.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/standard_error.h"
#include "sim/scenario/writer.h"
#include "tools/cli/command.h"
#include "tools/pipeline/map_coverage.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

std::string summary(const Scenario& scenario) {
  const std::size_t seas = sea_states(scenario.sea).size();
  const std::size_t aspects = views(scenario.view).size();
  const std::size_t cases = seas * aspects;
  const std::size_t maps = cases * scenario.targets.size() * static_cast<std::size_t>(scenario.dataset.maps_per_case);
  return fmt::format("{}: {} targets, {} sea states x {} views = {} cases, {} maps\n", scenario.name,
                     scenario.targets.size(), seas, aspects, cases, maps);
}

}  // namespace

void add_check(CLI::App& app, Shell& shell) {
  CLI::App* command =
      app.add_subcommand("check", "Read and validate a scenario, print it with every default written out");
  auto arguments = std::make_shared<ScenarioArguments>();
  add_scenario_arguments(*command, *arguments);
  command->footer("Example:\n  seaglint check scenarios/quick.yaml --set sea.peak_period_s=9");
  command->callback([arguments, &shell] {
    shell.work = [arguments] {
      const Scenario scenario = arguments->read();
      const Pipeline pipeline(scenario);  // reads every file the scenario names
      const PulseTrain train = make_pulse_train(scenario.radar, pipeline.window_m(), scenario.seed, 0);
      fmt::print("{}", effective_yaml(scenario));
      std::fflush(stdout);
      print_error(summary(scenario) + describe(train, scenario.radar));
      warn(mesh_doubts(pipeline));
      warn(sea_doubts(scenario));
      warn(outside_of_map(scenario, pipeline.targets()));
    };
  });
}

}  // namespace seaglint

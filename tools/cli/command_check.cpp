// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "radar/waveform/figures_of_merit.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/process/standard_error.h"
#include "sim/core/process/standard_output.h"
#include "sim/scenario/writer.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/map_coverage.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/scenario_summary.h"
#include "tools/pipeline/warnings.h"
#include "tools/report/learnable.h"

namespace seaglint {

namespace {

std::string summary(const Scenario& scenario, const SamplePlan& plan) {
  const std::size_t seas = plan.sea_states().size(), aspects = plan.views().size();
  const std::size_t parts = scenario.targets.size() - plan.classes().size();
  return fmt::format("{}: {} targets{}, {} sea states x {} views = {} cases, {} maps\n", scenario.name,
                     plan.classes().size(), parts > 0 ? fmt::format(" and {} parts", parts) : "", seas, aspects,
                     seas * aspects, plan.size());
}

// A line for each class that several targets share: it has the maps of all of them. Empty where each has one target.
std::string shared_classes(const Scenario& scenario, const SamplePlan& plan) {
  const std::vector<std::string>& classes = scenario.dataset.classes;
  std::string text;
  for (std::size_t label = 0; label < classes.size(); ++label) {
    std::vector<std::string> names;
    for (const int t : plan.classes()) {
      const TargetSpec& target = scenario.targets[static_cast<std::size_t>(t)];
      if (target.label == static_cast<int>(label)) names.push_back(target.name);
    }
    if (names.size() < 2) continue;
    text +=
        fmt::format("label {} ({}) is shared by {} targets ({}): {} of {} maps\n", label, classes[label], names.size(),
                    fmt::join(names, ", "), plan.size() / plan.classes().size() * names.size(), plan.size());
  }
  return text;
}

}  // namespace

void add_check(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("check", "Read and validate a scenario, print it with every default written out");
  auto arguments = std::make_shared<ScenarioArguments>();
  add_scenario_arguments(command, *arguments);
  command.footer("Example:\n  seaglint check scenarios/quick.yaml --set sea.peak_period_s=9");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      const Scenario scenario = arguments->read();
      const Pipeline pipeline(scenario);  // reads every file that the scenario names
      check_division(scenario, pipeline.plan());
      const PulseTrain train = make_pulse_train(scenario.radar, pipeline.window_m(), scenario.seed, 0);
      print_out("{}", effective_yaml(scenario));
      std::fflush(stdout);
      print_error(summary(scenario, pipeline.plan()) + shared_classes(scenario, pipeline.plan()) +
                  figures_of_merit_text(train, scenario.radar));
      const TrialLimit limit{kTrialSeconds, &context.stop};
      const WorkEstimate work = estimate_work(pipeline, limit);
      print_error(scenario_summary(pipeline, work, thread_count(0)));
      report_motion_files(pipeline);
      report_spectrum_table(scenario);
      warn(mesh_warnings(pipeline));
      warn(motion_warnings(pipeline));
      warn(sea_warnings(scenario, pipeline.plan().sea_states()));
      warn(map_coverage_warnings(pipeline));
      warn(constant_key_warnings(pipeline, limit));
      if (!work.failure.empty()) warn(std::vector{work.failure});
    };
  });
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"
#include "sim/scenario/key_list.h"
#include "sim/scenario/key_meanings.h"
#include "sim/scenario/writer.h"
#include "tools/cli/command_line.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/scenario_check.h"
#include "tools/pipeline/warnings.h"
#include "tools/run/run.h"

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

namespace {

struct KeysArguments {
  std::string of;
  bool json = false;
};

std::string keys_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const KeyEntry& entry : scenario_keys()) {
    list.push_back({{"key", entry.key},
                    {"default", entry.standard},
                    {"allowed", entry.allowed},
                    {"meaning", std::string(meaning_of(entry.key))}});
  }
  return list.dump(1) + "\n";
}

void run_keys(const KeysArguments& arguments) {
  if (arguments.json && !arguments.of.empty())
    throw InputError("--json lists all keys: it is used without a key or section");
  print_out("{}", arguments.json ? keys_json() : list_keys(arguments.of));
}

}  // namespace

void add_keys(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("keys", "List every key of a scenario file with its default and what it allows");
  auto arguments = std::make_shared<KeysArguments>();
  command.add_option("KEY", arguments->of, "Only this key or section, with what it means");
  command.add_flag("--json", arguments->json, "All keys with their meanings as JSON");
  command.footer("Example:\n  seaglint keys sea.gamma");
  command.callback([arguments, &context] { context.work = [arguments] { run_keys(*arguments); }; });
}

namespace {

namespace fs = std::filesystem;

// "quick.yaml, points.yaml"; by name.
std::string files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".yaml" || extension == ".glb") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

void print_paths() {
  const fs::path data = data_folder();
  print_out(
      "A relative name of a file is looked for in\n  1. the folder of the scenario that names it\n"
      "  2. the working directory     {}\n  3. the data of the program   {}\n",
      fs::current_path().string(), data.empty() ? "none found: set SEAGLINT_DATA" : data.string());
  if (data.empty()) return;
  print_out("scenarios         {}\nassets            {}\nassets/materials  {}\n", files_in(data / "scenarios"),
            files_in(data / "assets"), files_in(data / "assets/materials"));
}

}  // namespace

void add_paths(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command("paths", "Where files are looked for, and the data of the program");
  command.footer(
      "Scenarios of the program are found by their name alone: seaglint run quick.yaml -o build/quick\n"
      "Example:\n  seaglint paths");
  command.callback([&context] { context.work = print_paths; });
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/names.h"
#include "sim/scenario/keys.h"
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
  const std::string targets =
      is_sea_alone(scenario) ? "the sea alone" : fmt::format("{} targets", plan.classes().size());
  return fmt::format("{}: {}{}, {} sea states x {} views = {} cases, {} maps\n", scenario.name, targets,
                     parts > 0 ? fmt::format(" and {} parts", parts) : "", seas, aspects, seas * aspects, plan.size());
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
      print_out("{}", effective_yaml(scenario));
      std::fflush(stdout);
      print_error(summary(scenario, pipeline.plan()) + shared_classes(scenario, pipeline.plan()) +
                  figures_of_merit_text(pipeline.nominal_train(), scenario.radar));
      const TrialLimit limit{kTrialSeconds, &context.stop};
      const WorkEstimate work = estimate_work(pipeline, limit);
      print_error(scenario_summary(pipeline, work, thread_count(0)));
      report_scenario(pipeline, {.coverage = true});
      warn(constant_key_warnings(pipeline, limit));
      if (!work.failure.empty()) warn(std::vector{work.failure});
    };
  });
}

namespace {

struct KeysArguments {
  std::string of;
  bool json = false;
  bool schema = false;
};

void run_keys(const KeysArguments& arguments) {
  if ((arguments.json || arguments.schema) && !arguments.of.empty())
    throw InputError(
        fmt::format("{} lists all keys: it is used without a key or section", arguments.json ? "--json" : "--schema"));
  if (arguments.json && arguments.schema) throw InputError("--json and --schema exclude each other");
  print_out("{}", arguments.json ? keys_json() : arguments.schema ? scenario_schema() : list_keys(arguments.of));
}

}  // namespace

void add_keys(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("keys", "List every key of a scenario file with its default and what it allows");
  auto arguments = std::make_shared<KeysArguments>();
  command.add_option("KEY", arguments->of,
                     "Only this key or section, or the keys with this word in name or meaning: what they mean, and "
                     "which may be drawn");
  command.add_flag("--json", arguments->json, "All keys with their meanings as JSON");
  command.add_flag("--schema", arguments->schema, "JSON Schema of a scenario file, for editors");
  command.footer(
      "The line `# yaml-language-server: $schema=FILE` in a scenario names an editor the schema.\n"
      "Example:\n  seaglint keys sea.gamma\n  seaglint keys jitter");
  command.callback([arguments, &context] { context.work = [arguments] { run_keys(*arguments); }; });
}

namespace {

namespace fs = std::filesystem;

// What `init` writes, with the name of the scenario.
constexpr const char* kFirstScenario = R"yaml(seaglint: 1
name: "{}"
seed: 42
radar: {{carrier_ghz: 16, hop_count: 8, hop_step_mhz: 25, bandwidth_mhz: 25, pulse_width_us: 36, pri_us: 250, pulses: 256}}
view: {{azimuth_deg: [30, 120], elevation_deg: 2}}
sea: {{significant_wave_height_m: [0.1, 1], peak_period_s: uniform(7 9), propagation_deg: 120}}
targets:
  ship: {{label: 1, mesh: assets/combatant_144m.glb, motion: {{model: ship}}}}
  reflectors: {{label: 0, mesh: assets/icosahedral_reflector.glb, layout: {{line: {{count: 4, spacing_m: 40}}}}, motion: {{model: float}}}}
clutter: {{scr_db: 20}}
dataset: {{maps_per_case: 10, realisations_per_case: 10}}
)yaml";

void write_first_scenario(const std::string& name) {
  const fs::path file = name.ends_with(".yaml") ? name : name + ".yaml";
  if (fs::exists(file)) throw InputError(fmt::format("{}: is there already; choose another name", file.string()));
  const fs::path schema = data_folder() / "scenarios/schema.json";
  std::string head;
  if (!data_folder().empty() && fs::exists(schema))
    head = fmt::format("# yaml-language-server: $schema={}\n", fs::absolute(schema).string());
  head +=
      "# Keys that are not here have their defaults; `seaglint keys` lists all, `seaglint keys WORD` says what they "
      "mean.\n";
  const Scenario scenario =
      parse_scenario(fmt::format(fmt::runtime(kFirstScenario), file.stem().string()), file.string());
  write_file(file, commented_yaml(scenario, head));
  print_out(
      "{0}: written. The scenario with every default, its size and warnings; one map; data set, training and report:\n"
      "  seaglint check {0}\n"
      "  seaglint map {0} --sample 0 -o map.png\n"
      "  seaglint run {0} -o {1}\n",
      file.string(), (file.parent_path() / file.stem()).string());
}

}  // namespace

void add_init(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command("init", "Write a small scenario that works at once, with comments");
  auto name = std::make_shared<std::string>();
  command.add_option("NAME", *name, "The scenario is NAME.yaml, a new file").required();
  command.footer("Example:\n  seaglint init study");
  command.callback([name, &context] { context.work = [name] { write_first_scenario(*name); }; });
}

namespace {

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

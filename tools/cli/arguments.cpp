// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cli/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "classify/dataset/directory/dataset_writer.h"
#include "sim/core/process/error.h"

namespace seaglint {

void require_any_of(const CLI::App& command, const std::string& option, const std::vector<std::string>& others) {
  const auto given = [&](const std::string& name) { return command.count(name) > 0; };
  if (given(option) && std::none_of(others.begin(), others.end(), given))
    throw CLI::RequiresError(option, fmt::format("{}", fmt::join(others, " or ")));
}

std::filesystem::path find_data_set(const std::filesystem::path& directory) {
  const bool below = !exists(directory / kManifestFile) && exists(directory / "data" / kScenarioFile);
  return below ? directory / "data" : directory;
}

void add_threads_option(CLI::App& command, CommandContext& shell) {
  command.add_option("--threads", shell.threads, "Number of threads; 0 = all processors")->check(CLI::Range(0, 1024));
}

void add_scenario_arguments(CLI::App& command, ScenarioArguments& arguments) {
  command.add_option("SCENARIO", arguments.file, "Scenario file (YAML)")->required();
  command
      .add_option("--set", arguments.set, "Replace a value of the scenario, e.g. --set radar.pulses=64 (repeatable)")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
}

std::vector<Override> read_overrides(const std::vector<std::string>& set) {
  std::vector<Override> overrides;
  for (const std::string& text : set) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) throw InputError(fmt::format("--set {}: must be key.path=value", text));
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

Scenario ScenarioArguments::read() const { return read_scenario(file, read_overrides(set)); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <system_error>

#include "classify/dataset/directory/dataset_writer.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tools/cli/command.h"

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

void require_outputs(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs) {
  const auto place = [](const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path found = std::filesystem::weakly_canonical(file, error);
    return error ? file : found;
  };
  std::set<std::filesystem::path> read, written;
  for (const std::filesystem::path& file : inputs) read.insert(place(file));
  for (const std::string& file : outputs) {
    if (file.empty()) continue;
    if (read.contains(place(file))) throw InputError(fmt::format("{}: is read here, and would be written over", file));
    if (!written.insert(place(file)).second) throw InputError(fmt::format("{}: would be written twice", file));
    require_writable(file);
  }
}

std::vector<std::filesystem::path> files_of(const Scenario& scenario) {
  std::vector<std::filesystem::path> files;
  for (const InputFile& named : input_files(scenario)) files.push_back(named.path);
  return files;
}

void add_threads_option(CLI::App& command, Shell& shell) {
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

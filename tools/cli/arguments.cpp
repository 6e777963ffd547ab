// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cli/arguments.h"

#include <fmt/format.h>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/model/model_card.h"
#include "sim/core/process/error.h"
#include "sim/core/text/named_file.h"

namespace seaglint {

std::filesystem::path find_data_set(const std::filesystem::path& directory) {
  const bool below = !exists(directory / kManifestFile) && exists(directory / "data" / kScenarioFile);
  return below ? directory / "data" : directory;
}

std::filesystem::path find_model(const std::filesystem::path& directory) {
  const bool below = !exists(directory / kModelFile) && exists(directory / "model" / kModelFile);
  return below ? directory / "model" : directory;
}

void add_threads_option(CommandOptions& command, CommandContext& context) {
  command.add_option("--threads", context.threads, "Number of threads; 0 = all processors").integer_within(0, 1024);
}

void add_scenario_arguments(CommandOptions& command, ScenarioArguments& arguments) {
  command.add_option("SCENARIO", arguments.file, "Scenario file (YAML)").required();
  command.add_option("--set", arguments.set, "Replace a value of the scenario, e.g. --set radar.pulses=64 (repeatable)")
      .repeatable("KEY.PATH=VALUE");
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

Scenario ScenarioArguments::read() const { return read_scenario(find_input(file, "scenarios"), read_overrides(set)); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Arguments that several commands share.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/scenario.h"
#include "tools/cli/command.h"

namespace seaglint {

// Directory of the data set: the given one, or its `data`, where `run` writes it.
std::filesystem::path find_data_set(const std::filesystem::path& directory);

// Directory of the model: the given one, or its `model`, where `run` writes it.
std::filesystem::path find_model(const std::filesystem::path& directory);

// Adds --threads to a command.
void add_threads_option(CommandOptions& command, CommandContext& context);

// Parses the values of --set, `key.path=value` each. Throws InputError for one without `=`.
std::vector<Override> read_overrides(const std::vector<std::string>& set);

// Adds the positional SCENARIO and the repeatable --set key.path=value to a command, and reads them.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> set;
  Scenario read() const;  // throws InputError
};
void add_scenario_arguments(CommandOptions& command, ScenarioArguments& arguments);

}  // namespace seaglint

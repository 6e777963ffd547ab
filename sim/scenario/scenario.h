// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reading and writing scenario files, and the files that a scenario names.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/cases.h"
#include "sim/scenario/files/override.h"
#include "sim/scenario/scenario_spec.h"

namespace seaglint {

// Reads and checks a scenario. Throws InputError "file:line:col: key.path: value ...: bound" for the first thing that
// is wrong: unknown or duplicate keys, wrong types, values out of range, contradictions.
Scenario read_scenario(const std::filesystem::path& file, const std::vector<Override>& overrides = {});
Scenario parse_scenario(const std::string& yaml, const std::string& file_name,
                        const std::vector<Override>& overrides = {});

// "file:line:col: key.path" of a key or of its closest parent in the file; the key path alone when nothing was read.
std::string place_of(const Scenario& scenario, const std::string& key_path);

// The file a target's mesh path names: beside the scenario or below the working directory. Throws InputError when
// neither exists.
std::filesystem::path find_mesh(const Scenario& scenario, const TargetSpec& target);

// A file that a scenario names: what decides its maps beside its own text.
struct InputFile {
  std::string key;             // that names it
  std::filesystem::path path;  // where it was found
};

// All of them, in the order of the targets; a scenario of points alone has none. Throws InputError when one is missing.
std::vector<InputFile> input_files(const Scenario& scenario);

}  // namespace seaglint

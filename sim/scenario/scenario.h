// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reads scenario files and locates the files that they name.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/cases.h"
#include "sim/scenario/files/override.h"
#include "sim/scenario/scenario_spec.h"

namespace seaglint {

// Reads and checks a scenario. Throws InputError "file:line:col: key.path: value ...: bound", SeveralInputErrors where
// there are several: unknown or duplicate keys, wrong types, values out of range, inconsistencies of what is read
// without error. Invalid YAML is one error.
Scenario read_scenario(const std::filesystem::path& file, const std::vector<Override>& overrides = {});
Scenario parse_scenario(const std::string& yaml, const std::string& file_name,
                        const std::vector<Override>& overrides = {});

// The scenario with the drawn values of a place for its variations, of which it has none. The same for one without
// variations. Throws InputError for drawn values that contradict each other.
Scenario drawn_scenario(const Scenario& scenario, const DrawPlace& place);

// What a text states of a key: "uniform(0.5, 2), drawn per sea" where the scenario draws it, else `value`.
std::string value_text(const Scenario& scenario, const std::string& key_path, std::string value);

// "file:line:col: key.path" of a key or of its closest parent in the file; the key path alone without a file.
std::string place_of(const Scenario& scenario, const std::string& key_path);

// Mesh file of a target: searched in the folder of the scenario, then in the working directory. Throws InputError when
// neither exists.
std::filesystem::path find_mesh(const Scenario& scenario, const TargetSpec& target);

// An input file of a scenario, which affects its maps.
struct InputFile {
  std::string key;             // key that names it
  std::filesystem::path path;  // where it was found
};

// All input files, those of every choice of a drawn key too, in the order of the targets; empty for a scenario of
// points. Throws an InputError of all that are missing.
std::vector<InputFile> input_files(const Scenario& scenario);

}  // namespace seaglint

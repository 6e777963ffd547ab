// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// inputs.sha256: the checksum of every file that a scenario names, so that meshes, tables and codes behind the same
// names are known to be the same.

#include <filesystem>

#include "classify/dataset/directory/file_names.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// Throws InputError naming the key and its file where one is not what the directory's list says, or missing. A
// directory without a list agrees with everything.
void require_same_inputs(const std::filesystem::path& directory, const Scenario& scenario);

// Writes the list where there is none and the scenario names files.
void write_input_list(const std::filesystem::path& directory, const Scenario& scenario);

}  // namespace seaglint

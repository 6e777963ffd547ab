// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// inputs.sha256: the checksum of every file that a scenario names, to detect changed meshes, tables and codes under the
// same names.

#include <filesystem>

#include "classify/dataset/directory/file_names.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// Throws InputError naming the key and its file if one is missing or differs from the directory's list. Without a list
// every file passes.
void require_same_inputs(const std::filesystem::path& directory, const Scenario& scenario);

// Writes the list if there is none and the scenario names files.
void write_input_list(const std::filesystem::path& directory, const Scenario& scenario);

}  // namespace seaglint

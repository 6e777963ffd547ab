// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files that a piece of work reads and writes, checked before it begins.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Before any work: every file that a command is going to write can be written (WorkError), and none is another of them
// or one that the command reads (InputError). Empty names are none.
void require_outputs(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs);

// The files that a scenario names.
std::vector<std::filesystem::path> files_of(const Scenario& scenario);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Checks of input and output files before a command's work.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Throws WorkError if an output cannot be written, InputError if two outputs are one file or an output is an input.
// Empty names are skipped.
void require_outputs(const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs);

// The files that a scenario names.
std::vector<std::filesystem::path> files_of(const Scenario& scenario);

}  // namespace seaglint

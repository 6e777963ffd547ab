// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a user should know before believing a scenario's results.

#include <span>
#include <string>
#include <vector>

namespace seaglint {

class Pipeline;

// One line for everything that is doubtful about the meshes of the scenario's targets.
std::vector<std::string> mesh_doubts(const Pipeline& pipeline);

// Prints each as a warning.
void warn(std::span<const std::string> sentences);

}  // namespace seaglint

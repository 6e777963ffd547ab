// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a user should know before believing a scenario's results.

#include <span>
#include <string>
#include <vector>

namespace seaglint {

struct Scenario;
struct SeaState;
class Pipeline;

// One line for everything that is doubtful about the meshes of the scenario's targets.
std::vector<std::string> mesh_warnings(const Pipeline& pipeline);

// One line for each system of waves of the scenario's sea states with too few components to be the same sea from one
// realisation to the next.
std::vector<std::string> sea_warnings(const Scenario& scenario, std::span<const SeaState> states);

// One line where the carriers' bands leave gaps: maps then show targets in false places too.
std::vector<std::string> band_warnings(const Pipeline& pipeline);

// Prints each as a warning.
void warn(std::span<const std::string> sentences);

}  // namespace seaglint

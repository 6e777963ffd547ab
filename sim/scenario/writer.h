// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Writes the effective scenario: every field with its value, defaults included.

#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

// The scenario with all defaults as YAML; read_scenario() reads it back to the same values.
std::string effective_yaml(const Scenario& scenario);

// Keys of a section of the effective scenario with their values as YAML; the section must not have subsections.
std::vector<std::pair<std::string, std::string>> section_values(const Scenario& scenario, const std::string& section);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The effective scenario: every field with its value, defaults included.

#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

// The scenario with every default written out, as YAML that read_scenario takes back to the same value.
std::string effective_yaml(const Scenario& scenario);

// The keys of a section of the effective scenario with their values as YAML has them; of a section without sections in
// it.
std::vector<std::pair<std::string, std::string>> section_values(const Scenario& scenario, const std::string& section);

}  // namespace seaglint

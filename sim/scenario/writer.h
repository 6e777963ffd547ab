// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The effective scenario: every field with its value, defaults included.

#include <string>

#include "sim/scenario/scenario.h"

namespace seaglint {

// The scenario with every default written out, as YAML that read_scenario takes back to the same value.
std::string effective_yaml(const Scenario& scenario);

}  // namespace seaglint

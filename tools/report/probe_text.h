// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the report says of quantities that might give the class away, and of the level first among them.

#include <nlohmann/json.hpp>
#include <string>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Both return HTML, from metrics.json and what the scenario says of clutter and noise.
std::string probes_table(const nlohmann::ordered_json& metrics, const Scenario& scenario);
std::string note_of_level(const nlohmann::ordered_json& metrics, const Scenario& scenario);

}  // namespace seaglint

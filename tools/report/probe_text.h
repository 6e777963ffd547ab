// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Report texts on the probes, quantities that could reveal the class, and on the absolute level.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Both return HTML, from metrics.json and the scenario's clutter and noise settings.
std::string probes_table(const nlohmann::ordered_json& metrics, const Scenario& scenario);
std::string note_of_level(const nlohmann::ordered_json& metrics, const Scenario& scenario);

}  // namespace seaglint

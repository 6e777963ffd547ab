// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What is wrong with a scenario whose fields are right one by one.

#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/scenario_spec.h"

namespace seaglint {

// Throws InputError at the key that is most likely to be meant otherwise.
void check_contradictions(const Scenario& scenario, const ScenarioDocument& document);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Consistency checks of a scenario whose fields are individually valid.

#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/scenario_spec.h"

namespace seaglint {

// Throws InputError for the first inconsistency, at the key that most likely causes it.
void check_contradictions(const Scenario& scenario, const ScenarioDocument& document);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Consistency checks of a scenario whose fields are individually valid.

#include <set>
#include <string>

#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/scenario_spec.h"

namespace seaglint {

class ErrorList;

// Records an error for each inconsistency between keys without errors, at the key that most likely causes it.
void check_contradictions(const Scenario& scenario, const ScenarioDocument& document, ErrorList& errors);

// Throws InputError for a part that is not among `companions`, the companions that the scenario's targets have with any
// of its drawn values: it would be in no map.
void check_parts(const Scenario& scenario, const std::set<std::string>& companions, const ScenarioDocument& document);

}  // namespace seaglint

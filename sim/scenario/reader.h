// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reads a YAML tree into structs.

#include <functional>

#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/scenario_spec.h"

namespace seaglint {

class ErrorList;
class FieldVisitor;

// Reads every field. Records an error for each unknown or duplicate key, missing required one, wrong type and value out
// of its bounds; such a field has its default.
Scenario read_fields(const ScenarioDocument& document, ErrorList& errors);
// The same for another list of fields.
void read_fields(const ScenarioDocument& document, ErrorList& errors, const std::function<void(FieldVisitor&)>& fields);

}  // namespace seaglint

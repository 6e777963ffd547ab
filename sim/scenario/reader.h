// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reads a YAML tree into structs.

#include <functional>

#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/scenario_spec.h"

namespace seaglint {

class FieldVisitor;

// Reads every field. Throws InputError for unknown and duplicate keys, missing required ones, wrong types and values
// out of bounds.
Scenario read_fields(const ScenarioDocument& document);
// The same for another list of fields.
void read_fields(const ScenarioDocument& document, const std::function<void(FieldVisitor&)>& fields);

}  // namespace seaglint

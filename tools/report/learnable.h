// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rejects, before any map is made, what learning would reject.

#include "sim/scenario/sample_plan.h"

namespace seaglint {

// Throws InputError with the place in the scenario file for a learning.split of an unknown column, one that leaves
// nothing, or one class only, to train or to test on, and values that no map has. Values of columns that are measured
// on the maps are not known before. Does nothing for the default, a division by sea. `plan` of the same scenario.
void check_division(const Scenario& scenario, const SamplePlan& plan);

// The same, and for targets of one class only, and too few seas for a division by sea.
void check_learnable(const Scenario& scenario, const SamplePlan& plan);

}  // namespace seaglint

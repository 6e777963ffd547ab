// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One element of a table in the form of a solved sweep.

#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/rcs/rcs_sweep.h"

namespace seaglint {

// The values of `other` at the directions (0.001 deg) and frequencies (1e-6) of `cut`, as few sweeps with one model of
// its name; the element of `other` alone is filled, about the body's origin. Without phases the amplitudes are positive
// with the level's magnitude. Empty if no place is equal.
std::vector<RcsSweep> table_sweeps(const RcsCut& cut, const RcsCut& other);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Uniform times that were rounded when they were written.

#include <cstddef>
#include <vector>

#include "sim/core/text/text_table.h"

namespace seaglint {

// Times of a file: uniform to a thousandth of a step, rounded values of uniform ones, or neither.
enum class TimeGrid { kUniform, kRounded, kIrregular };

// Half of the last decimal that the numbers of a column have; 0 where they have more digits than a double.
double rounding_of(const TextTable& table, std::size_t column);

// Replaces ascending times, at least two, that all lie within `rounding` of one uniform grid by the uniform grid from
// the first to the last; leaves others. Rounding above 0.35 of the step leaves irregular times indistinguishable from
// uniform ones, and counts as irregular.
TimeGrid make_uniform(std::vector<double>& time, double rounding);

}  // namespace seaglint

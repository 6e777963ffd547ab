// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Ropes between the neighbours of a line of floats. A rope has no mass and does not stretch: it limits the horizontal
// distance of its ends, and is slack below its length.

#include <span>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Largest length by which a rope is too long after hold_places(), m, and length below the rope's at which it is taut.
inline constexpr double kRopeExcess_m = 1e-8, kTaut_m = 1e-6;

// Moves the points until no neighbours are further apart than length_m, in at most 50 passes. A pass has the least sum
// of squared displacements for ropes of fixed directions. Equal masses: the mean of the points stays.
void hold_places(std::span<Vec2> places, double length_m);

// The velocities nearest to the given ones, by the sum of squared differences, with which no taut rope lengthens. The
// mean velocity stays.
void hold_velocities(std::span<const Vec2> places, double length_m, std::span<Vec2> velocities);

}  // namespace seaglint

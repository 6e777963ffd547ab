// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The line of velocity over range on which the scattering centres of an elongated rigid body lie.

#include <span>

#include "classify/features/scattering_centres.h"

namespace seaglint {

// v = offset + slope r. A point x of a rigid body that rotates at w has the range rate r^.v_0 + w.(x cross r^), linear
// in its place across the line of sight and in its height; where both are proportional to range, as along a ship's
// length, it is linear in range.
struct VelocityLine {
  double slope = 0;   // 1/s
  double offset = 0;  // m/s, velocity at range 0

  double residual(const ScatteringCentre& centre) const {
    return centre.velocity_mps - (offset + slope * centre.range_m);
  }
};

// Robust and weighted: slope = weighted median of the slopes of all pairs of centres, weight A_i A_j |r_i - r_j| (Sen
// 1968; Jaeckel 1972), offset = median of v_i - slope r_i with weight A_i. It follows the line of most of the power
// whatever the velocities of the rest. Centres at one range have slope 0; without centres all is 0. Of more than 64
// centres the first 64 count, the strongest of clean_map().
VelocityLine robust_velocity_line(std::span<const ScatteringCentre> centres);

}  // namespace seaglint

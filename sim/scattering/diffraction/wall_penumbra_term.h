// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What physical optics lacks, per metre, of the echo of a wall that stands in penumbra on a face which the wave grazes
// (wall_penumbra.h), along a stretch of the wall.

#include <array>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// With s the sine of the wave's angle over the face, l the way on it from the rim to the wall, x = k l s^2: at the
// foot, at the rim's shadow line on the wall or on its image, and by the way from rim to wall and back.
struct WallPenumbraTerm {
  std::array<double, 2> l{};  // at the ends of the stretch, m, linear in between
  double sine = 0;            // s, -1 < s < 1
  // shares of the end at the foot, of that at the line, and of the way from the rim
  double foot_weight = 0, shadow_line_weight = 1, edge_path_weight = 1;
  bool soft = false;         // the electric field along the face, or the magnetic one
  double psi_decrement = 0;  // by how much the footprint's psi is less than the foot's, per metre of l
  // The part that turns with the angle. Near grazing both ways are infinite as 1 / s and cancel, so their sum is one
  // amplitude, with its first-order change: as a point's own phase changes, that is (e^{jk g ds} - 1) / (jk g) for ds.
  // Two footprints, of the sum less this and of this, the second with g, m, in its gradient along the face's normal.
  enum class Part { kComplete, kValue, kDerivative } part = Part::kComplete;
  double derivative_scale_m = 0;  // g

  // Times length / (j run) it is what one end of the stretch leaves of the integral of e^{jk psi}, psi's phase running
  // by `run` along it (not zero), rad.
  Complex at(double k, double share, double run) const;

 private:
  Complex at_sine(double s, double k, double share, double run) const;
};

}  // namespace seaglint

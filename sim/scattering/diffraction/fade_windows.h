// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Windows over which one asymptotic form goes over into another.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Ahead of an edge, near the shadow boundary of the beam along k_hat that it cuts, the diffracted field towards a
// mirror at a finite distance is no ray of its own: the beam's end on that mirror carries it. An echo by mirrors in
// direction s (before the first of them) fades out from right angles to the wave's way on, 1, to 30 deg off it, 0.
double fringe_forward_taper(const Vec3& k_hat, const Vec3& s);

// The same of the edge's own field, where that is told apart from the beam: from 18 deg off the wave's way on, 1, to
// 2.6 deg, 0.
double diffraction_forward_taper(const Vec3& k_hat, const Vec3& s);
double diffraction_forward_taper(double cosine);

}  // namespace seaglint

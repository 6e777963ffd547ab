// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// An infinite wedge with perfectly conducting faces.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Frame of one face of a wedge, unit vectors: x into the face, normal to the edge; n out of the conductor; t = x x n
// along the edge.
struct WedgeFace {
  Vec3 x, n, t;
};

// Smallest wedge index N: concave edges with less than 12 deg between their faces do not diffract; beams follow their
// reflections.
inline constexpr double kMinWedgeIndex = 1.0 / 15;

// An infinite wedge with perfectly conducting faces. The second face's t is minus the first one's.
struct WedgeFrame {
  WedgeFace face[2];
  // Wedge index, exterior angle / pi, kMinWedgeIndex <= N <= 2: 2 half-plane, 3/2 convex right angle, below 1 concave.
  double N = 2;
  double thickness_m = 0;  // of a half-plane, m (thick_edge.h)
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// An infinite wedge with perfectly conducting faces.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Cosine below which a facet is edge-on to a beam or to the receiver.
inline constexpr double kEdgeOn = 1e-9;

// One face of a wedge in its own frame: x into the face, across the edge; n out of the conductor; t = x x n along the
// edge.
struct WedgeFace {
  Vec3 x, n, t;
};

// Of corners sharper than this, 12 deg, as N: their reflections are followed by beams, their edges are not asked.
inline constexpr double kMinWedgeIndex = 1.0 / 15;

// An infinite wedge with perfectly conducting faces. The second face's t is minus the first one's.
struct WedgeFrame {
  WedgeFace face[2];
  // the exterior angle is N pi, 0 < N <= 2; 2 is a half-plane, below 1 a corner, not below kMinWedgeIndex
  double N = 2;
  double thickness_m = 0;  // of a half-plane (thick_edge.h)
};

}  // namespace seaglint

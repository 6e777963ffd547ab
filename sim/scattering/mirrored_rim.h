// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the rim of a mirror answers along the beam that the mirror sends on to others, as every corner reflector sees it.
//
// The beam ends at the rim. Physical optics of the last mirror ends there too and radiates that end in every direction; it is that end, not the one physical optics of the rim's own face
// would have, that the rim's exact field replaces. In the beam's own direction both are infinite alike, as -1/delta, delta the angle from it about the rim, and differ by what the projection of
// current onto the receiver's polarisation adds: across the rim, with the beam leaving a face under an angle a,
//
//     of the rim's own face  -1/delta -+ cot(a) / 2 (soft, hard; the rim nearer to the source has the other sign),    of the exact half-plane  -1/delta -+ 1 / (2 sin a)
//
// (Keller's coefficients, J. Opt. Soc. Am. 52 (1962) 116-130, and the end point of physical optics, expanded about the direction of reflection), all over 2 pi per metre of rim. A rim of a
// right-angled dihedral so answers -+(1 / sin a - tan a) / (4 pi): on the axis, a = 45 deg, what the fringe current of the last mirror's own rim has, towards the arm ever more.

#include <array>

#include "sim/scattering/edge_light.h"

namespace seaglint {

// The face of the wedge that reflects the wave towards s, and how nearly: 1 in the direction of reflection, 0 from 0.2 rad off it on, beside the wave's way on and where the wave grazes the face.
struct ReflectingFace {
  int face = 0;
  double share = 0;
};
ReflectingFace reflecting_face(const WedgeFrame& wedge, const Vec3& k_hat, const Vec3& s);

// hh, hv, vh, vv per metre of rim, to be added to what edge_currents() returns: the end of physical optics on the rim's own face less that on the last mirror of the way out, in the direction
// of reflection; zeros where the way out is direct, the rim's face being the last mirror itself.
std::array<double, 4> ends_of_beam(const WedgeFace& face, const EdgeArrival& in, const EdgeArrival& out);

}  // namespace seaglint

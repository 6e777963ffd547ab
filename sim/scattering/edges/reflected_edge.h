// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the rim of a mirror answers towards the mirrors after it, as every corner reflector and every wall on a deck
// sees it.
//
// The beam that the mirror sends on ends at the rim. Physical optics of the last mirror ends where the rim casts its
// shadow line, and radiates that end in every direction. In truth there is no line: the end is the rim's, on the way
// that its diffracted field takes by the mirrors to the receiver (beam_boundary.h moves it there), and of the rim's
// exact field it is that end, of the last mirror, which is left out here, not the one that physical optics of the rim's
// own face would have. Both are infinite alike in the beam's own direction, as -1/delta, delta the angle off it about
// the rim, and differ by what the projection of current onto the receiver's polarisation adds: across the rim, with the
// beam leaving a face under an angle a, to first order
//
//     of the rim's own face       -1/delta -+ cot(a) / 2 (soft, hard; the rim nearer to the source has the other sign)
//     of the exact half-plane     -1/delta -+ 1 / (2 sin a)
//
// (Keller's coefficients, J. Opt. Soc. Am. 52 (1962) 116-130, and the end point of physical optics, expanded about the
// direction of reflection), all over 2 pi per metre of rim. A rim of a right-angled dihedral so answers -+(1 / sin a -
// tan a) / (4 pi): on the axis, a = 45 deg, what the fringe current of the last mirror's own rim has, towards the arm
// ever more.

#include <array>

#include "sim/scattering/diffraction/wedge.h"
#include "sim/scattering/edges/edge_illumination.h"

namespace seaglint {

// By how much the beam along `beam` comes down on a mirror (normal `last`, of either sign) on the side that a way out
// along s comes from, 1, or grazes it, more than that way does, and ends far away or nowhere, 0.
double beam_incidence_taper(const Vec3& beam, const Vec3& s, const Vec3& last);

// What share of a rim's answer is as above, for a wave along k_hat on its face with normal n and a way out along s to a
// mirror with normal `last`: none near the wave's way on, where wave or way graze a mirror, and off Keller's cone about
// the rim (direction t), where its ends alone answer.
double reflected_edge_weight(const Vec3& n, const Vec3& t, const Vec3& k_hat, const Vec3& s, const Vec3& last);

// Of that what the wave's sine over the face leaves of it on the way out near the direction of reflection; the rest is
// wall_penumbra.h's.
double specular_grazing_weight(double sine);

// By what shares the faces of the wedge send a wave on by mirrors; with more mirrors on both ways than
// kMaxCorrectedReflections, whose shadow lines keep their ends, near the direction of reflection alone: 0 from 0.2 rad
// off it on.
inline constexpr int kMaxCorrectedReflections = 2;
std::array<double, 2> reflected_face_weights(const WedgeFrame& wedge, const EdgeIllumination& in,
                                             const EdgeIllumination& out);

// hh, hv, vh, vv per metre of rim, to be added to what equivalent_edge_currents() returns: the end of physical optics
// on the rim's own face less that on the last mirror of the way out; zeros where the way out is direct, the rim's face
// being the last mirror itself. On Keller's cone: off it the way out is turned onto it.
std::array<double, 4> endpoint_correction(const WedgeFace& face, const EdgeIllumination& in,
                                          const EdgeIllumination& out);

}  // namespace seaglint

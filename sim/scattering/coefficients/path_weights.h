// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Weights of forms that describe the same part of a field. The weights of two complementary forms sum to one.
//
// 1. Last reflectors at near-grazing angles, such as decks at low elevation, for one antenna. Physical optics lets only
//    the last reflector of a path radiate. The wave that a wall of height h reflects down to a deck ends there at h /
//    tan a (a: grazing angle), and in directions other than the specular one the deck radiates only the end-point
//    contributions of this boundary, each proportional to 1 / slope. The reciprocal path, via the deck to the wall, has
//    the transposed matrix; there the wall radiates, whose boundary is that of the body. With the weight
//    grazing_taper(), where the last reflector is long enough to contain the image of the first one, a path whose first
//    reflector is not at grazing incidence is replaced by its reciprocal, and a path from a reflector to a wall on it,
//    upright or leaning, possibly via others, and back via the same reflector or one parallel to it by the direct
//    radiation of the wall's image in the reflector. Over an unbounded deck both are exact (reciprocity and images:
//    Balanis, Advanced Engineering Electromagnetics, 7.5, 7.4).
// 2. The diffracted field of a reflector's edge towards later reflectors (radiation/reflected_edge.h), and the fringe
// current
//    of the beam that it bounds.
// 3. That field, and the penumbra term at the foot of a wall behind the edge (radiation/wall_penumbra.h).
// 4. The face-grazing wave that the wall reflects (radiation/multiple_diffraction.h), and the penumbra term of the path
// from
//    the edge to the wall and back, for the magnetic field parallel to the face.

#include <span>

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct ReflectorPanel {
  Vec3 normal;                    // unit, of either sign
  std::span<const Vec3> outline;  // of the panel
};

// Weight 0..2 of a path via a first and a last reflector, for one antenna along r; above 1 it includes the reciprocal
// path. The weights of a path and of its reciprocal sum to two.
double double_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& last);

// The same for paths via three and more reflectors, `before` the one before the last.
double multiple_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& before,
                              const ReflectorPanel& last);

// Weight 0..1 with which the wall's image in the reflector replaces the path from the reflector to the wall and back,
// the complement of multiple_bounce_weight(); 0 where the angle between the two is below 41 deg.
double image_weight(const Vec3& r, const ReflectorPanel& reflector, const ReflectorPanel& wall);

// Taper 0..1: 1 where the beam along `beam` meets a reflector (normal `last`, of either sign) on the side of the exit
// direction s, 0 where the beam is closer to grazing incidence than the exit path, so that its boundary lies far away
// or does not exist.
double beam_incidence_taper(const Vec3& beam, const Vec3& s, const Vec3& last);

// Weight 0..1 of the diffracted field of a reflector's edge, for a wave along k_hat on a face with normal n and an exit
// direction s towards a reflector with normal `last`: 0 near the forward direction, where wave or exit path graze a
// reflector, and off Keller's cone about the edge (direction t), where only the ends of the edge radiate.
double reflected_edge_weight(const Vec3& n, const Vec3& t, const Vec3& k_hat, const Vec3& s, const Vec3& last);

// Weights of the penumbra terms of a wall that stands upright on the face behind an edge, for one antenna at the sine
// of the grazing angle over the face, in the plane normal to edge and wall.
struct PenumbraWeights {
  double foot;       // complement of reflected_edge_weight() via the wall
  double edge_path;  // complement of grazing_wave_weight() via the wall, for H parallel to the face
};
PenumbraWeights penumbra_weights(double sine);

// Weight 0..1 of a face-grazing wave that walls reflect, or that starts at a concave edge: k_hat the direction of the
// wave at the edge that launches it, s the exit direction unfolded to that edge.
double grazing_wave_weight(const Vec3& k_hat, const Vec3& s);

}  // namespace seaglint

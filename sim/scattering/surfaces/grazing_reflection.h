// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Grazing treatment: last reflectors observed at near-grazing angles, such as decks at low elevation.
//
// PO lets only the last reflector of a beam's path radiate. The wave that a wall of height h reflects down to a deck
// ends there at h / tan a (a: grazing angle), and in directions other than the specular one the deck radiates only the
// end-point contributions of this boundary, each proportional to 1 / slope. For one antenna the reciprocal path, via
// the deck to the wall, has the transposed matrix; there the wall radiates, whose boundary is that of the body. Where
// the last reflector is at near-grazing incidence, with the weight grazing_taper(), and is long enough to contain the
// image of the first one,
//
// * a path whose first reflector is not at grazing incidence is replaced by the reciprocal path, S + S^T;
// * a path from a reflector to a wall on it, upright or leaning, possibly via others, and back via the same
//   reflector or one parallel to it, is replaced by the direct radiation of the wall's image in the reflector (image
//   theory).
//
// Over an unbounded deck both are exact (reciprocity and images: Balanis, Advanced Engineering Electromagnetics, 7.5,
// 7.4); the effect of the deck's edge is in wall_penumbra.h.

#include <span>

#include "sim/scattering/surfaces/footprint.h"

namespace seaglint {

struct ReflectorPanel {
  Vec3 normal;                    // unit, of either sign
  std::span<const Vec3> outline;  // of the panel
};

// Weight 0..1 of the grazing treatment: 1 at grazing incidence, 0 away from it, for the sine of the grazing angle; or
// for a direction s over a surface with normal n, both unit vectors.
double grazing_taper(double sine);
double grazing_taper(const Vec3& s, const Vec3& n);

// Weight 0..2 of a path via a first and a last reflector, or more, for one antenna along r; above 1 it includes the
// reciprocal path.
double double_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& last);

// The same for paths via three and more reflectors, `before` the one before the last.
double multiple_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& before,
                              const ReflectorPanel& last);

// Weight 0..1 with which the wall's image in the reflector replaces the path from the reflector to the wall and back; 0
// where the angle between the two is below 41 deg.
double image_weight(const Vec3& r, const ReflectorPanel& reflector, const ReflectorPanel& wall);

// Multiplies the pattern of a perfectly conducting footprint by a weight; the part above 1 is the transposed pattern
// (reciprocal path).
void weight_with_reciprocal(double share, Footprint& footprint);

}  // namespace seaglint

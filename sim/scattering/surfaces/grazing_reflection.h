// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Last mirrors that the way out grazes: decks, seen from a radar near the horizon.
//
// Of the mirrors on a beam's way physical optics lets the last one radiate. What a wall of height h sends down to a
// deck ends there, seen under the angle a over the deck, h / tan a away, and of what the wall sends off the direction
// of reflection the deck returns nothing but such ends, each as 1 / slope. For one antenna the same way run backwards,
// by the deck to the wall, is the transpose of it by reciprocity, and there the wall radiates, whose ends are those of
// the body. So where a last mirror is grazed, by the share grazing_taper(), and reaches as far as the first one, since
// else it ends before the beam does,
//
// * a way whose first mirror is not grazed is left to the way run backwards, S + S^T,
// * a way from a mirror to a wall that stands on it, upright or not, by others or not, and back by the same mirror, or
//   by one parallel to it, is what the wall radiates by the mirror: by image theory what its image radiates straight.
//
// Over a deck without end both are image theory (reciprocity and images: Balanis, Advanced Engineering
// Electromagnetics, 7.5, 7.4); what a deck's rim does besides is wall_penumbra.h's.

#include <span>

#include "sim/scattering/surfaces/footprint.h"

namespace seaglint {

struct ReflectorPanel {
  Vec3 normal;                    // unit, of either sign
  std::span<const Vec3> outline;  // of its panel
};

// From 0 to 1, whether a way in or out grazes a mirror, by the sine of its angle over it; along s, unit, one with unit
// normal n.
double grazing_taper(double sine);
double grazing_taper(const Vec3& s, const Vec3& n);

// What share of its echo, 0 to 2, a way from a first to a last of two mirrors, or of more, has for one antenna along r.
double double_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& last);

// The same of a way by three and more, where `before` is the one before the last.
double multiple_bounce_weight(const Vec3& r, const ReflectorPanel& first, const ReflectorPanel& before,
                              const ReflectorPanel& last);

// What share of the way from a mirror to a wall and back the wall's image in it has, 0 to 1: none where the two stand
// at less than 41 deg to each other.
double image_weight(const Vec3& r, const ReflectorPanel& reflector, const ReflectorPanel& wall);

// Gives a footprint of a perfect conductor a share of its echo; more than the whole is the way run backwards.
void weight_with_reciprocal(double share, Footprint& footprint);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The penumbra in which a wall stands on a face that the wave grazes, behind the face's rim: deck houses on decks at
// low elevation, and corner reflectors along an arm.
//
// Physical optics lights the wall in whole, and once more by the face up to z = b, both to a line; from below the face
// only above the rim's shadow, z > |b| (b = l tan a of the way l from rim to wall and the wave's angle a over the
// face). Within (lambda l)^(1/2) of the face neither is so: of either the half-plane's field goes from 1 to 0 (A.
// Sommerfeld; M. Born and E. Wolf, Principles of Optics, 8.7), F(z) = erfc(-c (z + b)) / 2 of the wave itself, c = e^{j
// pi/4} (k / 2l)^(1/2), F(-z) with -b of its image in the face. What wall and antenna make of it by reciprocity, soft
// and hard (-, +), is the integral over the wall of
//
//     [e^{jkzs} F(z) -+ e^{-jkzs} F(-z)]^2,   s = sin a,
//
// which a wall higher than the penumbra has in closed form: by parts the squares leave error functions at the foot,
// F(w), w^2 = jx, x = k l s^2, and the product, a convolution of two of them, (l / pi k)^(1/2) e^{-j pi/4} e^{-jx} (1 -
// F(x)) over the b that physical optics has, F(x) the transition function (wedge_diffraction.h). With erfc(w) = e^{-jx}
// F(x) / (pi j x)^(1/2), physical optics, that follows no wave which comes and goes by the face as rays do, lacks per
// metre of wall and -jk / 2 pi
//
//     by the rim and the wall's image of it    -1 / (2jks)         a > 0, at the phase of the foot
//     at the rim's shadow line                 e^{-2jx} / (2jks)   a < 0: that end is none
//     from the rim to the wall and back to it  (l / pi k)^(1/2) e^{-j pi/4} e^{-jx} [F(x) / (2jx) -+ (1 - F(x))]
//
// whose infinities on the boundary cancel. Where the wall's image in the face radiates up to z = b
// (grazing_reflection.h), (1 - e^{-2jx}) / (2jks), that is lacking no longer: at the foot -1 / (2jks) once more, and
// e^{-2jx} / (2jks) at the line of a > 0 as well. The last is, hard, the edge wave that the wall sends back
// (multiple_diffraction.h); soft it falls faster than any diffraction in a row, but in grazing it is as large: -2 (l /
// pi k)^(1/2) e^{-j pi/4} in all, by which a wall of height H on a face of length l answers less, where hard nothing is
// lacking. Away from grazing the first is reflected_edge.h's -1 / (4 pi sin a); both fade into one another.

#include <array>
#include <vector>

#include "sim/scattering/edges/edge_contribution.h"

namespace seaglint {

// A face that ends at a rim and on which a wall stands upright; all normals unit.
struct WallBehindEdge {
  Vec3 edge_point, edge_direction;  // a point of it and its direction, unit
  Vec3 face_normal;                 // on the lit side
  Vec3 wall_normal;                 // towards the rim
  double height = 0;                // of the wall, m; where it is no higher than the penumbra all fades out
  double image_weight = 0;          // what share of its echo by the face its image in it has (grazing_reflection.h)
  std::array<Vec3, 2> foot;         // ends of the stretch of the wall that stands behind the rim
  // whether an end is where the end of the rim shows on the wall, and moves along it as the direction turns; else it
  // stays
  std::array<bool, 2> ends_follow_edge{};
};

// Appends that for one antenna, as footprints that are like `foot_echo` but for phase, gradient, length and pattern.
// Echoes below min_amplitude_m at wavenumber k are left out.
void append_wall_penumbra(const WallBehindEdge& wall, const RadarBasis& antenna, const EdgeContribution& foot_echo,
                          double k, double min_amplitude_m, std::vector<EdgeContribution>& contributions);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Look direction of an antenna with its polarisation basis.

#include <cmath>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Look direction r^ (unit, from the target to the antenna) and polarisation basis h, v = r^ x h, body frame
// (CONVENTIONS.md, "Scattering").
struct RadarBasis {
  Vec3 r = Vec3::UnitX();
  Vec3 h = Vec3::UnitY();
  Vec3 v = Vec3::UnitZ();
};

inline bool operator==(const RadarBasis& a, const RadarBasis& b) { return a.r == b.r && a.h == b.h && a.v == b.v; }

// Unit vector from the target to the radar at this azimuth and elevation, rad, target frame (CONVENTIONS.md, "Frames").
inline Vec3 direction_to_radar(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

// Basis of the look direction r_hat (unit): h = z^ x r^ / |z^ x r^|, h = y^ where r^ is vertical; v = r^ x h.
inline RadarBasis radar_basis(const Vec3& r_hat) {
  const Vec3 across = Vec3::UnitZ().cross(r_hat), h = across.norm() < 1e-12 ? Vec3::UnitY() : across.normalized();
  return {r_hat, h, r_hat.cross(h)};
}

// Tolerances of the geometry that the solver's rooms share. A vertex is exact to the rounding of coordinates of some
// 100 m, 1e-14 m, times the operations of a clip; the smallest patch kept on the smallest targets is 1e-5 m wide.

// Points, lines and planes nearer to each other than this coincide, m: vertices on an edge, panels in one plane, edges
// that meet, lengths that count as zero.
inline constexpr double kCoincident = 1e-7;

// Angle, or its sine, below which a direction lies in a plane, rad: panels observed edge-on, diffracted rays on a
// shadow boundary, and the tilt of a grazing wave towards its face, by which rounding does not move it to the other
// side.
inline constexpr double kInPlaneAngle = 1e-7;

// 1 - cosine between the normals of facets that belong to one flat face; deviation of a wedge index from a right angle.
inline constexpr double kFlat = 1e-6;

// |cosine| below which a facet is edge-on to a beam or to the receiver.
inline constexpr double kEdgeOn = 1e-9;

}  // namespace seaglint

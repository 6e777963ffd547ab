// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Look direction of an antenna with its polarisation basis.

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
Vec3 direction_to_radar(double azimuth_rad, double elevation_rad);

// Basis of the look direction r_hat (unit): h = z^ x r^ / |z^ x r^|, h = y^ where r^ is vertical; v = r^ x h.
RadarBasis radar_basis(const Vec3& r_hat);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The directions to transmitter and receiver, each with its polarisation basis.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// The radar's direction and polarisation basis in the body frame: r^ x h = v (CONVENTIONS.md, "Scattering").
struct RadarBasis {
  Vec3 r = Vec3::UnitX();
  Vec3 h = Vec3::UnitY();
  Vec3 v = Vec3::UnitZ();
};

// Where the wave comes from and where its echo is received, each with the polarisation basis of its own direction.
struct BistaticGeometry {
  RadarBasis transmit;
  RadarBasis receive;
  bool monostatic = true;  // receive is transmit
};
BistaticGeometry monostatic(const RadarBasis& basis);
BistaticGeometry bistatic(const RadarBasis& transmit, const RadarBasis& receive);

// The unit vector from the target to the radar at these angles, rad, in the target frame (CONVENTIONS.md, "Frames").
Vec3 direction_to_radar(double azimuth_rad, double elevation_rad);

// h = z^ x r^ / |z^ x r^| (y^ when r^ is vertical), v = r^ x h.
RadarBasis radar_basis(const Vec3& r_hat);

}  // namespace seaglint

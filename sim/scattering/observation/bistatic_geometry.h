// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Observation by one or two antennas: their look directions, and the change of a path with them.

#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {

// Look directions of transmitter and receiver.
struct BistaticGeometry {
  RadarBasis transmit;
  RadarBasis receive;
  bool monostatic = true;  // receive equals transmit
};
BistaticGeometry monostatic(const RadarBasis& basis);
BistaticGeometry bistatic(const RadarBasis& transmit, const RadarBasis& receive);

// Path gradient, m: d psi = transmit . d r^_t + receive . d r^_s, or their sum for one common direction. For a
// body-fixed point these are its positions, in image space for the transmitter and in real space for the receiver
// (Fermat); the motion of a sliding point on the body adds to them.
struct PathGradient {
  Vec3 transmit = Vec3::Zero();
  Vec3 receive = Vec3::Zero();
  Vec3 transmit_slide = Vec3::Zero(), receive_slide = Vec3::Zero();  // part of them due to sliding

  Vec3 sum() const { return transmit + receive; }
};

// Linear interpolation from a (s = 0) to b (s = 1).
PathGradient interpolate(const PathGradient& a, const PathGradient& b, double s);

}  // namespace seaglint

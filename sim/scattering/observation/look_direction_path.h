// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Path of the look directions in body axes over the pulses that one aspect trace serves.

#include <span>
#include <vector>

#include "sim/scattering/observation/observation.h"

namespace seaglint {

// Tangent of the motion of both look directions per radian: r^_t + s transmit, r^_s + s receive, each normal to its own
// direction; unit length together.
struct LookDirectionTangent {
  Vec3 transmit = Vec3::UnitX();
  Vec3 receive = Vec3::Zero();

  // d psi / ds of a contribution, m.
  double path_rate(const PathGradient& gradient) const {
    return gradient.transmit.dot(transmit) + gradient.receive.dot(receive);
  }
};

// Look directions at the pulses relative to the traced directions: s along a straight track, q across it (the curvature
// of the path). One antenna needs no more; with two antennas the remaining components are smaller than q, since both
// directions follow one motion.
struct LookDirectionPath {
  LookDirectionTangent along_track, cross_track;
  std::vector<double> s, q;         // per pulse, rad
  double s_limit = 0, q_limit = 0;  // maximum magnitudes, rad
  double max_change = 0;            // maximum aspect change of either direction, rad
};

// transmit, receive: look directions of the pulses, at least one; the trace is made at transmit_at and receive_at. All
// unit vectors, body frame.
LookDirectionPath look_direction_path(std::span<const Vec3> transmit, std::span<const Vec3> receive,
                                      const Vec3& transmit_at, const Vec3& receive_at);

}  // namespace seaglint

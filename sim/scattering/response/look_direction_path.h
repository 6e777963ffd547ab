// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How the directions to the antennas move past a body while one trace serves it.

#include <span>
#include <vector>

#include "sim/scattering/surfaces/point_contributions.h"

namespace seaglint {

// A way that both directions move per radian, each across its own direction: r^_t + s transmit, r^_s + s receive. Both
// together are of unit length.
struct LookDirectionTangent {
  Vec3 transmit = Vec3::UnitX();
  Vec3 receive = Vec3::Zero();

  // d psi / ds of a contribution, m.
  double path_rate(const PathGradient& gradient) const {
    return gradient.transmit.dot(transmit) + gradient.receive.dot(receive);
  }
};

// Where the directions are at some pulses, seen from where a trace was made: s along a straight track and q beside it,
// the way the path bends. With one antenna that is the whole of it; with two the rest, which neither axis has, is
// smaller than q, since both directions follow one motion.
struct LookDirectionPath {
  LookDirectionTangent along_track, cross_track;
  std::vector<double> s, q;         // rad, of each pulse
  double s_limit = 0, q_limit = 0;  // largest magnitudes, rad
  double max_change = 0;            // largest of either direction, rad
};

// Of the pulses' directions, one or more, with the trace made at transmit_at and receive_at. All are unit vectors, body
// frame.
LookDirectionPath look_direction_path(std::span<const Vec3> transmit, std::span<const Vec3> receive,
                                      const Vec3& transmit_at, const Vec3& receive_at);

}  // namespace seaglint

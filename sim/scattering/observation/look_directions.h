// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Look directions of a moving radar, and of a radar at a finite range, and their path in body axes over the pulses that
// one aspect trace serves.

#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/observation/sea_reflection.h"

namespace seaglint {

// Look directions of the radar and of its image in the sea at one instant, target frame. The scene is fixed because the
// sea surface is: the radar's image descends as the radar climbs.
struct LineOfSight {
  RadarBasis radar, image;

  const RadarBasis& of(bool by_sea) const { return by_sea ? image : radar; }
  // Two-way path to x relative to the path to the origin, m, positive when shorter. range_m: distance of the radar from
  // the origin; 0: far field.
  double path_advance(const PropagationPath& path, const Vec3& x, double range_m = 0) const;
};

// The basis of the first pulse, that of r_hat, is transported without rotation about the line of sight; the image's
// basis is its mirror image.
LineOfSight line_of_sight_at(const IntervalSampling& sampling, const Vec3& r_hat, double time_s);

// Both look directions from the point x, transported in the same way.
LineOfSight line_of_sight_from(const LineOfSight& origin, const Vec3& x, double range_m);

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

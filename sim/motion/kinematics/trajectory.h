// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Attitude and position of one rigid body over time.

#include <vector>

#include "sim/core/numbers/pose.h"

namespace seaglint {

struct MotionSample {
  Vec3 angles = Vec3::Zero();             // roll, pitch, yaw, rad
  Vec3 angle_rates = Vec3::Zero();        // their time derivatives, rad/s
  Vec3 translation = Vec3::Zero();        // surge, sway, heave of the rotation centre, m
  Vec3 translation_rates = Vec3::Zero();  // m/s
};

// Uniform samples, interpolated by cubic Hermite polynomials (continuous rate).
class Trajectory {
 public:
  Trajectory() = default;  // at rest at the origin
  // rest_position: body origin at rest, in T, m; rotation_centre: body frame, m.
  Trajectory(double start_s, double step_s, std::vector<MotionSample> samples, Vec3 rest_position,
             Vec3 rotation_centre);

  // A fixed body.
  static Trajectory at_rest(const Vec3& rest_position);

  // The same motion plus a uniform drift: the pose is displaced by velocity (t - from_s); sample() excludes it.
  Trajectory with_drift(const Vec3& velocity, double from_s) const;

  // Trajectory of a frame that is fixed to the body, parallel to its own, with its origin at `point` (body frame, m).
  // sample() is unchanged: the translations remain those of the body's centre of rotation.
  Trajectory of_point(const Vec3& point) const;

  // The same motion of a body whose frame at rest is turned by `heading` (rad) about z. sample() is unchanged.
  Trajectory turned(double heading) const;

  // Motion at time t in [start, end]; throws std::out_of_range outside, beyond a tolerance of kEndSlack times the
  // duration for rounding.
  MotionSample sample(double t) const;
  static constexpr double kEndSlack = 2e-9;
  // Pose of the body frame in T: p = rest + shift + c - R c with c the rotation centre, plus the drift; axes
  // R Rz(heading).
  Pose pose(double t) const;

  // Infinite for a fixed body.
  double start_s() const;
  double end_s() const;

 private:
  double start_s_ = 0;
  double step_s_ = 1;
  std::vector<MotionSample> samples_;
  Vec3 rest_position_ = Vec3::Zero();
  Vec3 rotation_centre_ = Vec3::Zero();
  Vec3 carrying_mps_ = Vec3::Zero();
  double carried_from_s_ = 0;
  double heading_ = 0;
};

}  // namespace seaglint

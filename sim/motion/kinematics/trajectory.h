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
  // rest_position: where the body's origin rests in T; rotation_centre: in the body frame.
  Trajectory(double start_s, double step_s, std::vector<MotionSample> samples, Vec3 rest_position,
             Vec3 rotation_centre);

  // A body that never moves.
  static Trajectory at_rest(const Vec3& rest_position);

  // The same body carried along: its pose is displaced by velocity (t - from_s) besides, of which sample() knows
  // nothing.
  Trajectory with_drift(const Vec3& velocity, double from_s) const;

  // t within [start, end], else throws std::out_of_range; beyond them by kEndSlack of their distance it is rounding,
  // and taken for the end.
  MotionSample sample(double t) const;
  static constexpr double kEndSlack = 2e-9;
  // Of the body frame in the target frame at rest (T): p = rest + shift + c - R c with c the rotation centre, and where
  // it has been carried.
  Pose pose(double t) const;

  // A body at rest is at rest for ever: its start and end are infinite.
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
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Motion of one rigid body over time: the oscillator of a degree of freedom; attitude and position of the body.

#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/rotation.h"

namespace seaglint {

// A value of a specification, or what the shape of the body gives where it is 0.
inline double given_or(double value, double derived) { return value > 0 ? value : derived; }

// Oscillator of one degree of freedom: x'' + 2 z w0 x' + b |x'| x' + w0^2 x = f(t), f an acceleration.

struct Oscillator {
  double omega0 = 0;     // natural angular frequency, rad/s; 0 = no restoring force
  double damping = 0;    // z, ratio to critical
  double quadratic = 0;  // b, 1/rad (1/m for a translation)
};

struct OscillatorState {
  double x = 0;
  double rate = 0;
};

// Steady response to f = Re{e^{j w t}} per unit of f, without the quadratic damping; w > 0.
Complex linear_response(const Oscillator& oscillator, double omega);

// One step of the classical Runge-Kutta method of fourth order; f at the start, middle and end of the step.
OscillatorState advance(const Oscillator& oscillator, OscillatorState state, double f0, double f_middle, double f1,
                        double step);

// Largest omega0 h of one step h (error 2e-6 per step); longer steps are subdivided.
inline constexpr double kLongestTurn = 0.2;

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

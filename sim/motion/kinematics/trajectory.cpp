// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/kinematics/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "sim/core/process/error.h"

namespace seaglint {

Complex linear_response(const Oscillator& oscillator, double omega) {
  const double w0 = oscillator.omega0;
  return 1.0 / Complex(w0 * w0 - omega * omega, 2 * oscillator.damping * w0 * omega);
}

OscillatorState advance(const Oscillator& oscillator, OscillatorState state, double f0, double f_middle, double f1,
                        double step) {
  const auto derivative = [&](const OscillatorState& s, double f) {
    const double w0 = oscillator.omega0;
    return OscillatorState{s.rate, f - 2 * oscillator.damping * w0 * s.rate -
                                       oscillator.quadratic * std::abs(s.rate) * s.rate - w0 * w0 * s.x};
  };
  const auto moved = [&state](const OscillatorState& d, double h) {
    return OscillatorState{state.x + h * d.x, state.rate + h * d.rate};
  };
  const OscillatorState k1 = derivative(state, f0);
  const OscillatorState k2 = derivative(moved(k1, 0.5 * step), f_middle);
  const OscillatorState k3 = derivative(moved(k2, 0.5 * step), f_middle);
  const OscillatorState k4 = derivative(moved(k3, step), f1);
  return {state.x + step / 6 * (k1.x + 2 * k2.x + 2 * k3.x + k4.x),
          state.rate + step / 6 * (k1.rate + 2 * k2.rate + 2 * k3.rate + k4.rate)};
}

Trajectory::Trajectory(double start_s, double step_s, std::vector<MotionSample> samples, Vec3 rest_position,
                       Vec3 rotation_centre)
    : start_s_(start_s),
      step_s_(step_s),
      samples_(std::move(samples)),
      rest_position_(std::move(rest_position)),
      rotation_centre_(std::move(rotation_centre)) {
  SEAGLINT_CHECK(samples_.size() >= 2 && step_s_ > 0, fmt::format("{} samples, step {} s", samples_.size(), step_s_));
}

Trajectory Trajectory::at_rest(const Vec3& rest_position) {
  Trajectory constant;
  constant.rest_position_ = rest_position;
  return constant;
}

Trajectory Trajectory::with_drift(const Vec3& velocity, double from_s) const {
  Trajectory moving = *this;
  moving.carrying_mps_ = velocity;
  moving.carried_from_s_ = from_s;
  return moving;
}

Trajectory Trajectory::of_point(const Vec3& point) const {
  Trajectory shifted = *this;
  shifted.rest_position_ += point;
  if (!samples_.empty()) shifted.rotation_centre_ -= point;  // a body at rest does not rotate
  return shifted;
}

Trajectory Trajectory::turned(double heading) const {
  Trajectory turned = *this;
  turned.heading_ += heading;
  return turned;
}

double Trajectory::start_s() const { return samples_.empty() ? -std::numeric_limits<double>::infinity() : start_s_; }

double Trajectory::end_s() const {
  return samples_.empty() ? std::numeric_limits<double>::infinity()
                          : start_s_ + step_s_ * static_cast<double>(samples_.size() - 1);
}

namespace {

struct Hermite {
  Vec3 value;
  Vec3 rate;
};

// Cubic with values a, b and rates da, db at the ends of an interval of length h, at fraction u of it.
Hermite hermite(const Vec3& a, const Vec3& da, const Vec3& b, const Vec3& db, double h, double u) {
  const double v = 1 - u;
  return {(1 + 2 * u) * v * v * a + u * u * (3 - 2 * u) * b + h * u * v * (v * da - u * db),
          6 * u * v / h * (b - a) + v * (1 - 3 * u) * da + u * (3 * u - 2) * db};
}

}  // namespace

MotionSample Trajectory::sample(double t) const {
  if (samples_.empty() && !std::isnan(t)) return {};
  const double slack = kEndSlack * (end_s() - start_s());
  if (!(t >= start_s() - slack && t <= end_s() + slack)) {
    throw std::out_of_range(fmt::format("time {} s outside the trajectory's {} to {} s", t, start_s(), end_s()));
  }
  const double place = (std::clamp(t, start_s(), end_s()) - start_s_) / step_s_;
  const auto last = static_cast<double>(samples_.size() - 2);
  const double index = std::min(std::floor(place), last);
  const double u = place - index;
  const MotionSample& a = samples_[static_cast<std::size_t>(index)];
  const MotionSample& b = samples_[static_cast<std::size_t>(index) + 1];
  const Hermite angles = hermite(a.angles, a.angle_rates, b.angles, b.angle_rates, step_s_, u);
  const Hermite shift = hermite(a.translation, a.translation_rates, b.translation, b.translation_rates, step_s_, u);
  return {angles.value, angles.rate, shift.value, shift.rate};
}

Pose Trajectory::pose(double t) const {
  const MotionSample motion = sample(t);
  Pose pose;
  pose.R = rotation_from_angles(motion.angles.x(), motion.angles.y(), motion.angles.z());
  pose.p = rest_position_ + motion.translation + rotation_centre_ - pose.R * rotation_centre_;
  pose.p += (t - carried_from_s_) * carrying_mps_;
  if (heading_ != 0) pose.R = pose.R * rotation_from_angles(0, 0, heading_);
  return pose;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/kinematics/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

TEST(Trajectory, DriftsFromAGivenTime) {
  const Vec3 rest(1, 2, 3), velocity(-10, 0, 0);
  const Trajectory still = Trajectory::at_rest(rest).with_drift(velocity, 20);
  EXPECT_EQ(still.pose(20).p, rest);
  EXPECT_NEAR((still.pose(20.064).p - Vec3(1 - 0.64, 2, 3)).norm(), 0, 1e-12);
  EXPECT_EQ(still.pose(20.064).R, Mat3(Mat3::Identity()));
}

std::vector<MotionSample> oscillation(double omega, double step, int count) {
  std::vector<MotionSample> samples;
  for (int n = 0; n < count; ++n) {
    const double phase = omega * step * n;
    const Vec3 direction(0.1, -0.2, 0.3);
    samples.push_back({std::sin(phase) * direction, omega * std::cos(phase) * direction, std::cos(phase) * direction,
                       -omega * std::sin(phase) * direction});
  }
  return samples;
}

TEST(Trajectory, InterpolatesToFourthOrder) {
  const double omega = 5, step = 0.02;
  const Trajectory trajectory(0, step, oscillation(omega, step, 200), Vec3::Zero(), Vec3::Zero());
  for (double t = 0; t < 3.9; t += 0.0137) {
    const MotionSample motion = trajectory.sample(t);
    const Vec3 direction(0.1, -0.2, 0.3);
    // Hermite: (omega h)^4 / 384 of the value; the rate's largest error is (omega h)^3 sqrt(3)/216 times omega.
    EXPECT_NEAR((motion.angles - std::sin(omega * t) * direction).norm(), 0, std::pow(omega * step, 4) / 384);
    EXPECT_NEAR((motion.translation - std::cos(omega * t) * direction).norm(), 0, std::pow(omega * step, 4) / 384);
    EXPECT_NEAR((motion.angle_rates - omega * std::cos(omega * t) * direction).norm(), 0,
                omega * std::pow(omega * step, 3) * std::sqrt(3.0) / 216);
  }
}

TEST(Trajectory, IsContinuousInValueAndRateAtItsSamples) {
  const double step = 0.1;
  const Trajectory trajectory(-1, step, oscillation(9, step, 50), Vec3::Zero(), Vec3::Zero());
  for (int n = 1; n < 48; ++n) {
    const double t = -1 + n * step;
    const MotionSample before = trajectory.sample(t - 1e-9), after = trajectory.sample(t + 1e-9);
    EXPECT_NEAR((before.angles - after.angles).norm(), 0, 1e-7);
    EXPECT_NEAR((before.angle_rates - after.angle_rates).norm(), 0, 1e-6);
  }
  EXPECT_EQ(trajectory.start_s(), -1);
  EXPECT_NEAR(trajectory.end_s(), -1 + 49 * step, 1e-12);
  EXPECT_NO_THROW(trajectory.sample(trajectory.end_s()));
}

TEST(Trajectory, RefusesTimesOutsideItself) {
  const Trajectory trajectory(0, 0.1, oscillation(1, 0.1, 11), Vec3::Zero(), Vec3::Zero());
  EXPECT_THROW(trajectory.sample(-0.01), std::out_of_range);
  EXPECT_THROW(trajectory.sample(1.01), std::out_of_range);
  EXPECT_THROW(trajectory.sample(NAN), std::out_of_range);
}

TEST(Trajectory, RotatesTheBodyAboutItsRotationCentre) {
  MotionSample tilted;
  tilted.angles = {0.3, -0.2, 0.5};
  tilted.translation = {1, 2, 3};
  const Vec3 rest(10, 20, 0.75), centre(1, -2, -0.75);
  const Trajectory trajectory(0, 1, {tilted, tilted}, rest, centre);
  const Pose pose = trajectory.pose(0.5);
  // The rotation centre is only translated.
  EXPECT_NEAR((pose.R * centre + pose.p - (rest + centre + tilted.translation)).norm(), 0, 1e-14);
  EXPECT_NEAR((pose.R - rotation_from_angles(0.3, -0.2, 0.5)).norm(), 0, 1e-15);
}

TEST(Trajectory, AtRestIsConstant) {
  const Trajectory still = Trajectory::at_rest({1, 2, 3});
  for (const double t : {-1e9, 0.0, 1e9}) {
    EXPECT_EQ((still.pose(t).p - Vec3(1, 2, 3)).norm(), 0);
    EXPECT_EQ((still.pose(t).R - Mat3::Identity()).norm(), 0);
  }
}

// Amplitudes at the turning points of a free decay from x = x0 at rest.
std::vector<double> peaks_of_decay(const Oscillator& oscillator, double x0, double step, double duration) {
  std::vector<double> peaks;
  OscillatorState state{x0, 0};
  for (double t = 0; t < duration; t += step) {
    const OscillatorState next = advance(oscillator, state, 0, 0, 0, step);
    if (state.rate != 0 && state.rate * next.rate <= 0) {
      // The rate passes zero inside the step: the value there by a parabola through it.
      const double fraction = state.rate / (state.rate - next.rate);
      peaks.push_back(state.x + 0.5 * fraction * step * state.rate);
    }
    state = next;
  }
  return peaks;
}

TEST(Oscillator, DecaysWithTheLogarithmicDecrementOfLinearDamping) {
  const double zeta = 0.075;
  const Oscillator roll{2 * kPi / 10.9, zeta, 0};
  const std::vector<double> peaks = peaks_of_decay(roll, 0.1, 0.02, 60);
  ASSERT_GE(peaks.size(), 8u);
  // ln(x_n / x_n+2) = 2 pi zeta / sqrt(1 - zeta^2); half a period per turning point.
  const double decrement = kPi * zeta / std::sqrt(1 - zeta * zeta);
  double last = 0.1;
  for (const double peak : peaks) {
    EXPECT_NEAR(std::log(std::abs(last / peak)), decrement, 1e-6);
    last = peak;
  }
}

// While x' > 0, p = x'^2 obeys dp/dx + 2 b p = -2 w0^2 x, so that between two turning points -X and X' the integral of
// x e^{2 b x} vanishes: (2 b x - 1) e^{2 b x} has the same value at both. A downward swing is its mirror image.
TEST(Oscillator, DecaysByTheFirstIntegralOfQuadraticDamping) {
  const double b = 0.5;
  const Oscillator roll{2 * kPi / 10.9, 0, b};
  double last = 0.3;
  for (const double signed_peak : peaks_of_decay(roll, 0.3, 0.02, 100)) {
    const double peak = std::abs(signed_peak);
    const auto integral = [b](double x) { return (2 * b * x - 1) * std::exp(2 * b * x); };
    EXPECT_NEAR(integral(peak), integral(-last), 1e-6);
    last = peak;
  }
  EXPECT_LT(last, 0.15);
}

TEST(Oscillator, ReachesItsSteadyResponse) {
  const Oscillator roll{0.6, 0.1, 0};
  const double omega = 0.8;
  const Complex expected = linear_response(roll, omega);
  OscillatorState state;
  constexpr double kStep = 0.02;
  constexpr int kSteps = 20000;  // e^{-0.1 0.6 400} = 4e-11
  for (int n = 0; n < kSteps; ++n) {
    const auto f = [&](double t) { return std::cos(omega * t); };
    state = advance(roll, state, f(n * kStep), f((n + 0.5) * kStep), f((n + 1) * kStep), kStep);
  }
  const Complex phasor = expected * std::polar(1.0, omega * kSteps * kStep);
  EXPECT_NEAR(state.x, phasor.real(), 1e-8);
  EXPECT_NEAR(state.rate, -omega * phasor.imag(), 1e-8);
}

TEST(Oscillator, IsIntegratedToFourthOrder) {
  const Oscillator swing{1, 0.05, 0.3};
  const auto end = [&](int steps) {
    OscillatorState state{0.2, 0.1};
    const double step = 10.0 / steps;
    for (int n = 0; n < steps; ++n)
      state = advance(swing, state, std::sin(n * step), std::sin((n + 0.5) * step), std::sin((n + 1) * step), step);
    return state.x;
  };
  const double fine = end(12800);
  // |x'| x' has a jump in its second derivative where the rate passes zero, which reduces the order a little.
  EXPECT_GT(std::abs(end(50) - fine) / std::abs(end(100) - fine), 7);
}

}  // namespace
}  // namespace seaglint

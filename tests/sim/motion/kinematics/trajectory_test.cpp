// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/kinematics/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

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

}  // namespace
}  // namespace seaglint

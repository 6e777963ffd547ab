// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/feature_vector.h"

#include <gtest/gtest.h>

namespace seaglint {
namespace {

TEST(MotionFeatures, OfARotatingLineAreThoseOfARigidBody) {
  std::vector<ScatteringCentre> centres;
  for (const double r : {-60.0, -20.0, 20.0, 60.0}) centres.push_back({r, 0.4 - 0.002 * r, 1});
  const MotionFeatures features = motion_features(centres);
  EXPECT_NEAR(features.rotation_per_s, 0.002, 1e-15);
  EXPECT_NEAR(features.residual_mps, 0, 1e-15);
  EXPECT_NEAR(features.explained, 1, 1e-12);
  EXPECT_NEAR(features.on_line, 1, 1e-12);
}

// A square in (r, v): of four pairs of equal weight two have slope 0, one 0.02 and one -0.02 per second, so that the
// line is flat; its level is the lower velocity, with half of the amplitude.
TEST(MotionFeatures, OfIndependentPointsHaveWhatNoRotationExplains) {
  const std::vector<ScatteringCentre> centres = {{-20, -0.4, 1}, {20, 0.4, 1}, {-20, 0.4, 1}, {20, -0.4, 1}};
  const MotionFeatures features = motion_features(centres);
  EXPECT_NEAR(features.rotation_per_s, 0, 1e-15);
  EXPECT_NEAR(features.residual_mps, 0.4, 1e-15);
  EXPECT_NEAR(features.explained, 0, 1e-15);
  EXPECT_NEAR(features.on_line, 0.5, 1e-15);
}

TEST(MotionFeatures, OfALineWithOneOutlierShowTheLine) {
  std::vector<ScatteringCentre> centres;
  for (int i = 0; i < 9; ++i) centres.push_back({10.0 * i - 40, 0.001 * (10 * i - 40), 1});
  centres.push_back({5, 3, 1});
  const MotionFeatures features = motion_features(centres);
  EXPECT_NEAR(features.rotation_per_s, 0.001, 1e-15);
  EXPECT_NEAR(features.residual_mps, 0.1 * (3 - 0.005), 1e-12);
  EXPECT_NEAR(features.on_line, 0.9, 1e-12);
}

TEST(MotionFeatures, DoNotDependOnPlaceMeanVelocityAndLevel) {
  const std::vector<ScatteringCentre> centres = {{-31, 0.1, 1}, {-2, 0.5, 2.5}, {14, -0.4, 5}, {47, 0.05, 3}};
  std::vector<ScatteringCentre> other = centres;
  for (ScatteringCentre& centre : other) {
    centre.range_m += 500;
    centre.velocity_mps -= 4;
    centre.amplitude_m *= 1e-6;
  }
  const MotionFeatures a = motion_features(centres), b = motion_features(other);
  EXPECT_NEAR(a.rotation_per_s, b.rotation_per_s, 1e-13);
  EXPECT_NEAR(a.residual_mps, b.residual_mps, 1e-12);
  EXPECT_NEAR(a.explained, b.explained, 1e-12);
  EXPECT_NEAR(a.on_line, b.on_line, 1e-12);
}

TEST(MotionFeatures, OfFewCentresAreFinite) {
  EXPECT_EQ(motion_features({}).on_line, 0);
  const MotionFeatures one = motion_features(std::vector<ScatteringCentre>{{4, 1, 1}});
  EXPECT_EQ(one.rotation_per_s, 0);
  EXPECT_EQ(one.explained, 0);
  EXPECT_EQ(one.on_line, 1);
}

}  // namespace
}  // namespace seaglint

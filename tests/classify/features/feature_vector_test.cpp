// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "classify/features/feature_vector.h"
#include "classify/features/scattering_centres.h"

namespace seaglint {

namespace {

TEST(Features, OfCentresOnALineHaveNoResidual) {
  std::vector<ScatteringCentre> centres;
  for (int i = 0; i < 7; ++i) centres.push_back({10.0 * i - 25, 0.03 * (10.0 * i - 25) + 0.4, 1.0 + i});
  for (const bool weighted : {false, true}) {
    FeatureSpec spec;
    spec.weighted_fit = weighted;
    const FeatureVector features = compute_features(centres, spec);
    EXPECT_NEAR(features.mwr, 0, 1e-28);
    EXPECT_NEAR(features.sigma_r, 10 * std::sqrt((49 - 1) / 12.0), 1e-12);  // equally spaced: d sqrt((N^2 - 1)/12)
    EXPECT_NEAR(features.sigma_v, 0.03 * features.sigma_r, 1e-12);
    EXPECT_EQ(features.centres, 7);
    EXPECT_FALSE(features.degenerate);
  }
}

TEST(Features, FollowTheirFormulasForFourCentres) {
  // A square in (r, v) with amplitudes 1, 1, 3, 3: the line is flat at the mean, residuals are +-h.
  const double h = 0.2;
  const std::vector<ScatteringCentre> centres = {{-20, -h, 1}, {20, h, 1}, {-20, h, 3}, {20, -h, 3}};
  FeatureSpec spec;
  const FeatureVector features = compute_features(centres, spec);
  EXPECT_NEAR(features.mwr, h * h, 1e-15);  // weights 0.5, 0.5, 1.5, 1.5 have mean 1
  EXPECT_NEAR(features.sigma_r, 20, 1e-12);
  EXPECT_NEAR(features.sigma_v, h, 1e-15);
  EXPECT_NEAR(features.ccf, (0.5 - 0.4) / (0.5 + 0.4 + 1e-6), 1e-12);  // 20/40 against 0.2/0.5

  // Unequal residuals: weights matter. Amplitudes 1, 1, 4 and residuals from the unweighted line.
  const std::vector<ScatteringCentre> uneven = {{-1, 0, 1}, {1, 0, 1}, {0, 3, 4}};  // line v = 1: residuals -1, -1, 2
  EXPECT_NEAR(compute_features(uneven, spec).mwr, (0.5 * 1 + 0.5 * 1 + 2 * 4) / 3, 1e-12);
  spec.weighted_fit = true;  // line v = 2: residuals -2, -2, 1
  EXPECT_NEAR(compute_features(uneven, spec).mwr, (0.5 * 4 + 0.5 * 4 + 2 * 1) / 3, 1e-12);
}

TEST(Features, DoNotDependOnTheScaleOfTheAmplitudes) {
  const std::vector<ScatteringCentre> weak = {{-3, 0.1, 1e-6}, {5, 0.5, 2e-6}, {0, -0.4, 5e-6}, {11, 0, 3e-6}};
  std::vector<ScatteringCentre> strong = weak;
  for (ScatteringCentre& centre : strong) centre.amplitude_m *= 1e9;
  EXPECT_NEAR(compute_features(weak, {}).mwr, compute_features(strong, {}).mwr, 1e-15);
}

TEST(Features, OfFewOrCoincidentCentresAreFiniteAndFlagged) {
  const std::vector<std::vector<ScatteringCentre>> cases = {
      {}, {{4, 1, 1}}, {{4, 1, 1}, {4, 2, 1}}, {{4, 1, 0}, {8, 2, 0}}, {{4, 1, 1}, {4, 1, 1}, {4, 3, 1}}};
  for (const auto& centres : cases) {
    const FeatureVector features = compute_features(centres, {});
    EXPECT_EQ(features.degenerate, centres.size() < 3);
    for (const double value : {features.mwr, features.ccf, features.sigma_r, features.sigma_v})
      EXPECT_TRUE(std::isfinite(value));
    EXPECT_GE(features.ccf, 0);
    EXPECT_LE(features.ccf, 1);
  }
  EXPECT_NEAR(compute_features(cases[2], {}).mwr, 0.25, 1e-15);     // one range: the line is the mean
  EXPECT_NEAR(compute_features(cases[4], {}).mwr, 8.0 / 9, 1e-15);  // 1, 1, 3 about 5/3
}

TEST(VelocityLine, IsThatOfPointsOnALine) {
  std::vector<ScatteringCentre> centres;
  for (const double r : {-51.0, -20.0, 3.5, 12.0, 64.0}) centres.push_back({r, 0.3 - 0.002 * r, 1 + 0.01 * r});
  const VelocityLine line = robust_velocity_line(centres);
  EXPECT_NEAR(line.slope, -0.002, 1e-15);
  EXPECT_NEAR(line.offset, 0.3, 1e-15);
  for (const ScatteringCentre& centre : centres) EXPECT_NEAR(line.residual(centre), 0, 1e-15);
}

// Of six equal centres on a line and two far from it: the 15 pairs on the line weigh 700 m, the 13 others 380 m.
TEST(VelocityLine, IgnoresAMinorityOfOtherCentres) {
  std::vector<ScatteringCentre> centres;
  for (int i = 0; i < 6; ++i) centres.push_back({20.0 * i - 50, 0.001 * (20 * i - 50), 1});
  centres.push_back({-10, 3, 1});
  centres.push_back({10, -5, 1});
  const VelocityLine line = robust_velocity_line(centres);
  EXPECT_NEAR(line.slope, 0.001, 1e-15);
  EXPECT_NEAR(line.offset, 0, 1e-15);
}

TEST(VelocityLine, IgnoresManyWeakCentresBesideFewStrongOnes) {
  std::vector<ScatteringCentre> centres = {{-40, 0.1, 1}, {0, 0.2, 1}, {40, 0.3, 1}};
  for (int i = 0; i < 20; ++i) centres.push_back({3.0 * i - 30, i % 2 == 0 ? 1.0 : -2.0, 0.01});
  const VelocityLine line = robust_velocity_line(centres);
  EXPECT_NEAR(line.slope, 0.0025, 1e-15);
  EXPECT_NEAR(line.offset, 0.2, 1e-15);
}

TEST(VelocityLine, HasNoSlopeWithoutTwoRanges) {
  EXPECT_EQ(robust_velocity_line({}).offset, 0);
  const VelocityLine line = robust_velocity_line(std::vector<ScatteringCentre>{{4, 1, 1}, {4, 2, 3}});
  EXPECT_EQ(line.slope, 0);
  EXPECT_EQ(line.offset, 2);
}

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

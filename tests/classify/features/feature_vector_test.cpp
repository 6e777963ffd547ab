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

}  // namespace
}  // namespace seaglint

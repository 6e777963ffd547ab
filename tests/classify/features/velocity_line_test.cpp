// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/feature_vector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seaglint {
namespace {

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

}  // namespace
}  // namespace seaglint

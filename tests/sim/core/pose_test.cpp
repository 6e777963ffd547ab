// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/rotation.h"

#include <gtest/gtest.h>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

TEST(RotationFromAngles, FollowsTheConventions) {
  const double quarter = kPi / 2;
  // Roll turns y (port) towards z; pitch puts the bow down; yaw turns the bow to port.
  EXPECT_NEAR((rotation_from_angles(quarter, 0, 0) * Vec3::UnitY() - Vec3::UnitZ()).norm(), 0, 1e-15);
  EXPECT_NEAR((rotation_from_angles(0, quarter, 0) * Vec3::UnitX() + Vec3::UnitZ()).norm(), 0, 1e-15);
  EXPECT_NEAR((rotation_from_angles(0, 0, quarter) * Vec3::UnitX() - Vec3::UnitY()).norm(), 0, 1e-15);
}

TEST(RotationFromAngles, IsYawTimesPitchTimesRoll) {
  const Mat3 product =
      rotation_from_angles(0, 0, 0.7) * rotation_from_angles(0, -0.3, 0) * rotation_from_angles(0.2, 0, 0);
  EXPECT_NEAR((rotation_from_angles(0.2, -0.3, 0.7) - product).norm(), 0, 1e-15);
}

TEST(Pose, MapsLocalCoordinatesToTheOuterFrame) {
  const Pose outer = upright(Vec3(1, 2, 3), kPi / 2);
  EXPECT_NEAR((outer * Vec3(1, 0, 0.5) - Vec3(1, 3, 3.5)).norm(), 0, 1e-15);
  const Pose inner{Vec3(0.3, -0.2, 0.1), rotation_from_angles(0.2, -0.3, 0.7)};
  const Vec3 local(0.4, 0.5, -0.6);
  EXPECT_NEAR(((outer * inner) * local - outer * (inner * local)).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace seaglint

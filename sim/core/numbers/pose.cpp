// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/pose.h"

namespace seaglint {

Pose upright(const Vec3& p, double yaw) { return {p, Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix()}; }

Mat3 rotation_from_angles(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
          Eigen::AngleAxisd(roll, Vec3::UnitX()))
      .toRotationMatrix();
}

}  // namespace seaglint

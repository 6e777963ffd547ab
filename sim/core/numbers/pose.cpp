// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/pose.h"
#include "sim/core/numbers/rotation.h"

namespace seaglint {

Pose upright(const Vec3& p, double yaw) { return {p, axis_rotation(yaw, Vec3::UnitZ())}; }

Mat3 rotation_from_angles(double roll, double pitch, double yaw) {
  return (axis_quaternion(yaw, Vec3::UnitZ()) * axis_quaternion(pitch, Vec3::UnitY()) *
          axis_quaternion(roll, Vec3::UnitX()))
      .matrix();
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Position and orientation of one Cartesian frame in another.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Maps local coordinates to the outer frame: x = p + R x_local. The columns of R are the local axes, p (m) is the local
// origin.
struct Pose {
  Vec3 p = Vec3::Zero();
  Mat3 R = Mat3::Identity();

  Vec3 operator*(const Vec3& local) const { return p + R * local; }
  Pose operator*(const Pose& inner) const { return {p + R * inner.p, R * inner.R}; }
};

// Origin at p, rotated by yaw (rad) about z.
Pose upright(const Vec3& p, double yaw = 0);

// R_WB = Rz(yaw) Ry(pitch) Rx(roll), angles in rad (CONVENTIONS.md, "Frames").
Mat3 rotation_from_angles(double roll, double pitch, double yaw);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rotations about axes and between directions.

#include "sim/core/numbers/linear.h"

namespace seaglint {

// R of a rotation by an angle, rad, about a unit vector.
Mat3 axis_rotation(double angle, const Vec3& axis);

// cos(angle / 2) and axis sin(angle / 2).
struct Quaternion {
  double w = 1;
  Vec3 v = Vec3::Zero();

  Quaternion operator*(const Quaternion& b) const;
  Vec3 operator*(const Vec3& x) const;
  Mat3 matrix() const;
};

Quaternion axis_quaternion(double angle, const Vec3& axis);
// The smallest rotation from one direction to another.
Quaternion rotation_between(const Vec3& from, const Vec3& to);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rotations about axes and between directions; position and orientation of one Cartesian frame in another; principal
// axes of a symmetric matrix.

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

// Eigenvalues and eigenvectors of a symmetric matrix.
struct PrincipalAxes {
  Vec3 values;  // ascending
  Mat3 axes;    // columns: unit vectors in the order of the values
};
PrincipalAxes principal_axes(const Mat3& symmetric);

}  // namespace seaglint

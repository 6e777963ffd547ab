// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/rotation.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace seaglint {

// O. Rodrigues (1840): R = cos I + sin [axis]x + (1 - cos) axis axis^T.
Mat3 axis_rotation(double angle, const Vec3& axis) {
  const double c = std::cos(angle);
  const Vec3 s = std::sin(angle) * axis, n = (1 - c) * axis;
  const double xy = n.x() * axis.y(), xz = n.x() * axis.z(), yz = n.y() * axis.z();
  return {{n.x() * axis.x() + c, xy + s.z(), xz - s.y()},
          {xy - s.z(), n.y() * axis.y() + c, yz + s.x()},
          {xz + s.y(), yz - s.x(), n.z() * axis.z() + c}};
}

Quaternion Quaternion::operator*(const Quaternion& b) const {
  return {(w * b.w - v.y() * b.v.y()) - (v.z() * b.v.z() + v.x() * b.v.x()),
          {(w * b.v.x() + v.y() * b.v.z()) - (v.z() * b.v.y() - v.x() * b.w),
           (w * b.v.y() + v.y() * b.w) + (v.z() * b.v.x() - v.x() * b.v.z()),
           (w * b.v.z() - v.y() * b.v.x()) + (v.z() * b.w + v.x() * b.v.y())}};
}

Vec3 Quaternion::operator*(const Vec3& x) const {
  const Vec3 u = v.cross(x), twice = u + u;
  return x + w * twice + v.cross(twice);
}

Mat3 Quaternion::matrix() const {
  const double tx = 2 * v.x(), ty = 2 * v.y(), tz = 2 * v.z();
  const double wx = tx * w, wy = ty * w, wz = tz * w;
  const double xx = tx * v.x(), xy = ty * v.x(), xz = tz * v.x(), yy = ty * v.y(), yz = tz * v.y(), zz = tz * v.z();
  return {{1 - (yy + zz), xy + wz, xz - wy}, {xy - wz, 1 - (xx + zz), yz + wx}, {xz + wy, yz - wx, 1 - (xx + yy)}};
}

Quaternion axis_quaternion(double angle, const Vec3& axis) {
  return {std::cos(0.5 * angle), std::sin(0.5 * angle) * axis};
}

Quaternion rotation_between(const Vec3& from, const Vec3& to) {
  constexpr double kOpposite = 1e-12;  // of 1 + cosine, below which the cross product gives no axis
  const Vec3 a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  if (cosine < -1 + kOpposite) {
    return {0, a.unitOrthogonal()};
  }
  const double s = std::sqrt((1 + cosine) * 2);
  return {s * 0.5, a.cross(b) * (1 / s)};
}

Pose upright(const Vec3& p, double yaw) { return {p, axis_rotation(yaw, Vec3::UnitZ())}; }

Mat3 rotation_from_angles(double roll, double pitch, double yaw) {
  return (axis_quaternion(yaw, Vec3::UnitZ()) * axis_quaternion(pitch, Vec3::UnitY()) *
          axis_quaternion(roll, Vec3::UnitX()))
      .matrix();
}

PrincipalAxes principal_axes(const Mat3& symmetric) {
  Eigen::Matrix3d matrix;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) matrix(i, j) = symmetric(i, j);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  PrincipalAxes result;
  for (int j = 0; j < 3; ++j) {
    result.values[j] = solver.eigenvalues()[j];
    for (int i = 0; i < 3; ++i) result.axes(i, j) = solver.eigenvectors()(i, j);
  }
  return result;
}

}  // namespace seaglint

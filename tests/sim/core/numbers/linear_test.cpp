// SPDX-License-Identifier: BSD-3-Clause
// Laws of vectors, matrices and rotations, and their bits against those of Eigen, with which recorded results were
// computed.
#include "sim/core/numbers/linear.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <random>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"

namespace seaglint {
namespace {

constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();  // of a few operations on numbers of order 1
constexpr int kCases = 1000;

class Draw {
 public:
  double number() { return normal_(generator_); }
  Complex complex() { return {number(), number()}; }
  Vec2 plane() { return {number(), number()}; }
  Vec3 vector() { return {number(), number(), number()}; }
  CVec3 complex_vector() { return {complex(), complex(), complex()}; }
  Mat3 matrix() { return {vector(), vector(), vector()}; }

 private:
  std::mt19937_64 generator_{1};
  std::normal_distribution<double> normal_;
};

Eigen::Vector3d eigen(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3cd eigen(const CVec3& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Matrix3d eigen(const Mat3& m) {
  Eigen::Matrix3d out;
  for (int j = 0; j < 3; ++j) out.col(j) = eigen(m.col(j));
  return out;
}
Vec3 plain(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Mat3 plain(const Eigen::Matrix3d& m) {
  return {plain(Eigen::Vector3d(m.col(0))), plain(Eigen::Vector3d(m.col(1))), plain(Eigen::Vector3d(m.col(2)))};
}

TEST(Linear, CrossProductIsOrthogonalAndOfTheParallelogramsArea) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = draw.vector(), b = draw.vector(), c = a.cross(b);
    const double size = a.norm() * b.norm();
    EXPECT_NEAR(c.dot(a), 0, kRounding * size * a.norm());
    EXPECT_NEAR(c.dot(b), 0, kRounding * size * b.norm());
    EXPECT_NEAR(c.squaredNorm(), size * size - a.dot(b) * a.dot(b), kRounding * size * size);
    EXPECT_EQ(b.cross(a), -c);
  }
}

TEST(Linear, OrthogonalUnitVectorIsOneAlsoAlongTheAxes) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = n < 3 ? (n == 0 ? Vec3::UnitX() : n == 1 ? Vec3::UnitY() : Vec3::UnitZ()) : draw.vector();
    EXPECT_NEAR(a.unitOrthogonal().dot(a), 0, kRounding * a.norm());
    EXPECT_NEAR(a.unitOrthogonal().norm(), 1, kRounding);
  }
  EXPECT_EQ(Vec3::Zero().normalized(), Vec3::Zero());
}

TEST(Linear, ProductsOfMatricesAssociateAndTransposeInReverse) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Mat3 A = draw.matrix(), B = draw.matrix();
    const Vec3 v = draw.vector();
    const double size = A.norm() * B.norm();
    EXPECT_LE((A * B * v - A * (B * v)).norm(), kRounding * size * v.norm());
    EXPECT_LE((Mat3((A * B).transpose()) - Mat3(B.transpose()) * Mat3(A.transpose())).norm(), kRounding * size);
    EXPECT_LE((A.transpose() * v - Mat3(A.transpose()) * v).norm(), kRounding * A.norm() * v.norm());
    EXPECT_NEAR((A * B).determinant(), A.determinant() * B.determinant(), kRounding * size * size * size);
    EXPECT_NEAR((A * B).trace(), (B * A).trace(), kRounding * size);
  }
}

TEST(Linear, InverseTimesItsMatrixIsOne) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Mat3 A = draw.matrix(), inverse = A.inverse();
    const double condition = A.norm() * inverse.norm();
    EXPECT_LE((inverse * A - Mat3::Identity()).norm(), kRounding * condition * condition);
  }
}

TEST(Linear, OuterProductOfUnitVectorsProjects) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = draw.vector(), b = draw.vector(), v = draw.vector();
    EXPECT_LE((outer_product(a, b) * v - a * b.dot(v)).norm(), kRounding * a.norm() * b.norm() * v.norm());
    const Vec2 p = draw.plane(), q = draw.plane(), u = draw.plane();
    EXPECT_LE((outer_product(p, q) * u - p * q.dot(u)).norm(), kRounding * p.norm() * q.norm() * u.norm());
  }
}

TEST(Rotation, KeepsLengthsAndAnglesAndItsAxis) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 axis = draw.vector().normalized(), v = draw.vector();
    const double angle = kPi * draw.number();
    const Mat3 R = axis_rotation(angle, axis);
    EXPECT_NEAR((R * v).norm(), v.norm(), kRounding * v.norm());
    EXPECT_LE((R * axis - axis).norm(), kRounding);
    EXPECT_NEAR(R.trace(), 1 + 2 * std::cos(angle), kRounding);
    EXPECT_NEAR(R.determinant(), 1, kRounding);
    EXPECT_LE((axis_quaternion(angle, axis).matrix() - R).norm(), kRounding);
    EXPECT_LE((axis_quaternion(angle, axis) * v - R * v).norm(), kRounding * v.norm());
  }
}

TEST(Rotation, BetweenDirectionsTurnsOneIntoTheOther) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = draw.vector(), b = draw.vector();
    EXPECT_LE((rotation_between(a, b) * a.normalized() - b.normalized()).norm(),
              kRounding / (a.normalized() + b.normalized()).norm());
    EXPECT_LE((rotation_between(a, -a) * a + a).norm(), kRounding * a.norm());
  }
}

TEST(PrincipalAxes, DiagonaliseASymmetricMatrix) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Mat3 A = draw.matrix(), S = A + A.transpose();
    const PrincipalAxes found = principal_axes(S);
    EXPECT_TRUE(found.values[0] <= found.values[1] && found.values[1] <= found.values[2]);
    for (int k = 0; k < 3; ++k)
      EXPECT_LE((S * found.axes.col(k) - found.values[k] * found.axes.col(k)).norm(), kRounding * S.norm());
  }
}

TEST(Linear, HasTheBitsOfEigen) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = draw.vector(), b = draw.vector();
    const Mat3 A = draw.matrix(), B = draw.matrix();
    const CVec3 u = draw.complex_vector();
    const Complex c = draw.complex();
    const Eigen::Vector3d a_e = eigen(a), b_e = eigen(b);
    const Eigen::Matrix3d A_e = eigen(A), B_e = eigen(B);
    EXPECT_EQ(a.dot(b), a_e.dot(b_e));
    EXPECT_EQ(a.norm(), a_e.norm());
    EXPECT_EQ(a.sum(), a_e.sum());
    EXPECT_EQ(a.normalized(), plain(a_e.normalized()));
    EXPECT_EQ(a.cross(b), plain(a_e.cross(b_e)));
    EXPECT_EQ(a.unitOrthogonal(), plain(a_e.unitOrthogonal()));
    EXPECT_EQ(A * b, plain(Eigen::Vector3d(A_e * b_e)));
    EXPECT_EQ(A.transpose() * b, plain(Eigen::Vector3d(A_e.transpose() * b_e)));
    EXPECT_EQ(A * B, plain(Eigen::Matrix3d(A_e * B_e)));
    EXPECT_EQ(A * B.transpose(), plain(Eigen::Matrix3d(A_e * B_e.transpose())));
    EXPECT_EQ(A.inverse(), plain(Eigen::Matrix3d(A_e.inverse())));
    EXPECT_EQ(A.determinant(), A_e.determinant());
    EXPECT_EQ(A.trace(), A_e.trace());
    EXPECT_EQ(outer_product(a, b), plain(Eigen::Matrix3d(a_e * b_e.transpose())));
    EXPECT_EQ(a.dot(u), a_e.dot(eigen(u)));
    EXPECT_EQ(eigen(c * a), c * a_e);
    EXPECT_EQ(eigen(c * u), c * eigen(u));
    const Vec3 axis = a.normalized();
    EXPECT_EQ(axis_rotation(b.x(), axis), plain(Eigen::AngleAxisd(b.x(), eigen(axis)).toRotationMatrix()));
    const Eigen::Quaterniond q_e =
        Eigen::AngleAxisd(b.x(), eigen(axis)) * Eigen::AngleAxisd(b.y(), Eigen::Vector3d::UnitX());
    const Quaternion q = axis_quaternion(b.x(), axis) * axis_quaternion(b.y(), Vec3::UnitX());
    EXPECT_EQ(q.matrix(), plain(q_e.toRotationMatrix()));
    EXPECT_EQ(q * b, plain(q_e * b_e));
  }
}

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

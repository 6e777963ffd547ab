// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

constexpr double kRounding = 1e-12;  // of the radius, as the header states; distances here are sums of three squares

std::vector<Vec3> random_points(std::uint64_t seed, int count) {
  Random random({seed, Stream::kTest, 0});
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    Vec3 p;
    for (double& x : p) x = random.uniform() * 2 - 1;
    points.push_back(p);
  }
  return points;
}

// The smallest sphere is the one that contains all points and whose centre lies in the convex hull of those on it: no
// direction exists in which the centre could move away from none of them.
TEST(BoundingSphere, ContainsAllPointsAndCannotShrink) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const std::vector<Vec3> points = random_points(seed, 3 + static_cast<int>(seed) * 7);
    const Sphere sphere = bounding_sphere(points);
    std::vector<Vec3> on_it;
    for (const Vec3& p : points) {
      EXPECT_LE((p - sphere.centre).norm(), sphere.radius * (1 + 2 * kRounding));
      if ((p - sphere.centre).norm() > sphere.radius * (1 - 1e-9)) on_it.push_back(p);
    }
    for (const Vec3& direction : random_points(1000 + seed, 200)) {
      double least = 1;
      for (const Vec3& p : on_it) least = std::min(least, direction.dot(p - sphere.centre));
      EXPECT_LE(least, 1e-9) << seed;
    }
  }
}

TEST(BoundingSphere, OfKnownBodies) {
  const auto of = [](const TriangleMesh& mesh) { return bounding_sphere(mesh.vertices); };
  EXPECT_NEAR(of(make_sphere(2.5, 3)).radius, 2.5, 2.5 * kRounding);
  EXPECT_NEAR(of(make_plate(3, 4)).radius, 2.5, 2.5 * kRounding);
  EXPECT_NEAR(of(make_cylinder(3, 8, 24)).radius, 5, 5 * kRounding);
  // A right isosceles triangle and the apex: the centre of the trihedron's opening, at a third of (leg, leg, leg).
  const Sphere trihedral = of(make_triangular_trihedral(1));
  EXPECT_NEAR(trihedral.radius, std::sqrt(2.0 / 3), kRounding);
  EXPECT_NEAR((trihedral.centre - Vec3::Constant(1.0 / 3)).norm(), 0, kRounding);
}

TEST(BoundingSphere, TurnsAndMovesWithTheBody) {
  const std::vector<Vec3> points = random_points(7, 500);
  const Sphere sphere = bounding_sphere(points);
  const Mat3 R = axis_rotation(1.1, Vec3(1, -2, 0.5).normalized());
  const Vec3 shift(1000, -200, 30);
  std::vector<Vec3> moved;
  for (const Vec3& p : points) moved.push_back(R * p + shift);
  const Sphere again = bounding_sphere(moved);
  // Positions 1 km away are rounded by 1e-13 m each.
  EXPECT_NEAR(again.radius, sphere.radius, 1e-12);
  EXPECT_NEAR((again.centre - (R * sphere.centre + shift)).norm(), 0, 2e-12);
}

TEST(BoundingSphere, OfRepeatedAndCollinearPoints) {
  EXPECT_EQ(bounding_sphere({}).radius, 0);
  const std::vector<Vec3> one(5, Vec3(1, 2, 3));
  EXPECT_EQ(bounding_sphere(one).radius, 0);
  EXPECT_EQ(bounding_sphere(one).centre, Vec3(1, 2, 3));
  std::vector<Vec3> line;
  for (int i = 0; i <= 10; ++i) line.push_back(Vec3(1, 1, 1) + i * Vec3(0.1, -0.2, 0.05));
  EXPECT_NEAR(bounding_sphere(line).radius, Vec3(0.5, -1, 0.25).norm(), kRounding);
}

TEST(BoundingSphere, OfNoNumbersIsThatOfNoPoints) {
  EXPECT_EQ(bounding_sphere(std::vector<Vec3>(3, Vec3(std::nan(""), 0, 0))).radius, 0);
}

}  // namespace
}  // namespace seaglint

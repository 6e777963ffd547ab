// SPDX-License-Identifier: BSD-3-Clause
// Bodies that are recognised from their mesh, and those that are none of them.
#include "sim/canonical/canonical_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

// Moved and turned so that no axis or origin is special.
TriangleMesh displaced(const TriangleMesh& mesh) {
  const Mat3 rotation = axis_rotation(0.4, Vec3(1, 2, -0.5).normalized());
  return transformed(mesh, rotation, Vec3(3, -2, 0.7));
}

// Coordinates in single precision, as of files, each triangle with vertices of its own.
TriangleMesh as_of_a_file(const TriangleMesh& mesh) {
  TriangleMesh soup = mesh;
  soup.vertices.clear();
  for (auto& triangle : soup.triangles) {
    for (std::uint32_t& vertex : triangle) {
      soup.vertices.push_back(mesh.vertices[vertex].cast<float>().cast<double>());
      vertex = static_cast<std::uint32_t>(soup.vertices.size() - 1);
    }
  }
  return soup;
}

TEST(CanonicalBodies, SphereHasItsCentreAndRadius) {
  const auto body = canonical_body(as_of_a_file(displaced(make_sphere(0.3, 3))));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->shape, CanonicalShape::kSphere);
  EXPECT_NEAR(body->a_m, 0.3, 1e-6);
  EXPECT_LT((body->centre_m - Vec3(3, -2, 0.7)).norm(), 1e-6);
  EXPECT_EQ(text_of(*body), "sphere of radius 0.3 m");
}

TEST(CanonicalBodies, PlateHasItsSidesAndNormal) {
  for (const auto& [length, width] : {std::pair{0.5, 0.3}, {0.4, 0.4}, {10.0, 0.2}}) {
    const auto body = canonical_body(as_of_a_file(displaced(make_plate(length, width))));
    ASSERT_TRUE(body) << length;
    EXPECT_EQ(body->shape, CanonicalShape::kPlate);
    EXPECT_NEAR(body->a_m, length, 1e-5);
    EXPECT_NEAR(body->b_m, width, 1e-5);
    EXPECT_NEAR(body->axes.determinant(), 1, 1e-5);
  }
}

TEST(CanonicalBodies, DihedralHasItsFacesAndSeam) {
  const auto body = canonical_body(as_of_a_file(make_dihedral(0.25, 0.3, kPi / 2)));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->shape, CanonicalShape::kDihedral);
  EXPECT_NEAR(body->a_m * body->b_m, 0.25 * 0.3, 1e-6);
  EXPECT_NEAR(std::abs(body->axes.col(2).z()), 1, 1e-6);
  EXPECT_NEAR((body->axes.col(0) + body->axes.col(1)).normalized().x(), 1, 1e-6);
}

TEST(CanonicalBodies, TrihedralHasItsLegsAndApex) {
  const auto body = canonical_body(as_of_a_file(displaced(make_triangular_trihedral(0.5))));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->shape, CanonicalShape::kTriangularTrihedral);
  EXPECT_NEAR(body->a_m, 0.5, 1e-5);
  EXPECT_LT((body->centre_m - Vec3(3, -2, 0.7)).norm(), 1e-5);
}

TEST(CanonicalBodies, SquareTrihedralIsNotATriangularOne) {
  const auto body = canonical_body(displaced(make_square_trihedral(0.4)));
  ASSERT_TRUE(body);
  EXPECT_EQ(body->shape, CanonicalShape::kSquareTrihedral);
  EXPECT_NEAR(body->a_m, 0.4, 1e-9);
}

TEST(CanonicalBodies, OthersAreNone) {
  EXPECT_FALSE(canonical_body({}));
  EXPECT_FALSE(canonical_body(make_dihedral(0.25, 0.3, radians(89)))) << "not at right angles";
  TriangleMesh ellipsoid = make_sphere(1, 3);
  for (Vec3& p : ellipsoid.vertices) p.z() *= 1.01;
  EXPECT_FALSE(canonical_body(ellipsoid));
  EXPECT_FALSE(canonical_body(make_sphere(1, 0))) << "an icosahedron";
  TriangleMesh dented = make_sphere(1, 3);
  dented.triangles.resize(dented.triangles.size() * 9 / 10);
  EXPECT_FALSE(canonical_body(dented)) << "a sphere with a hole";
  TriangleMesh half = make_plate(0.5, 0.3);
  half.triangles.resize(half.triangles.size() / 2);
  EXPECT_FALSE(canonical_body(half)) << "half a plate";
  EXPECT_FALSE(canonical_body(make_icosahedral_reflector()));
  EXPECT_FALSE(canonical_body(make_cylinder(0.5, 1, 64)));
  TriangleMesh cut = make_triangular_trihedral(0.5);
  cut.triangles.pop_back();
  EXPECT_NE(canonical_body(cut).value_or(CanonicalBody{}).shape, CanonicalShape::kTriangularTrihedral);
}

TEST(CanonicalBodies, SpheresOfOneMeshAreAllFound) {
  TriangleMesh spheres = transformed(make_sphere(0.2, 3), Mat3::Identity(), Vec3(-8, 0, 0));
  spheres.append(make_sphere(0.3, 3));
  const std::vector<CanonicalBody> bodies = canonical_bodies(spheres);
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_NEAR(bodies[0].a_m, 0.2, 1e-6);
  EXPECT_NEAR(bodies[1].a_m, 0.3, 1e-6);
  spheres.append(make_plate(1, 1));
  EXPECT_TRUE(canonical_bodies(spheres).empty()) << "a plate among them";
}

}  // namespace
}  // namespace seaglint

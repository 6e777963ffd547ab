// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/shapes/generators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/mesh/topology.h"

namespace seaglint {
namespace {

constexpr double kRounding = 1e-12;  // of doubles, for sums of a few hundred terms of order one

TEST(PlateMesh, HasItsAreaAndFacesForward) {
  const TriangleMesh plate = make_plate(0.3, 0.2);
  ASSERT_EQ(plate.triangles.size(), 2u);
  EXPECT_NEAR(surface_area(plate), 0.06, kRounding);
  for (std::size_t t = 0; t < 2; ++t) EXPECT_NEAR(area_vector(plate, t).x(), 0.03, kRounding);
  EXPECT_NEAR(bounds(plate).upper.y(), 0.15, kRounding);
  EXPECT_NEAR(bounds(plate).upper.z(), 0.10, kRounding);
}

TEST(DihedralMesh, IsOpenForwardWithItsAngleAtAVerticalSeam) {
  const TriangleMesh dihedral = make_dihedral(0.4, 0.3, radians(90));
  EXPECT_NEAR(surface_area(dihedral), 2 * 0.4 * 0.3, kRounding);
  const Topology topology = topology_of(dihedral);
  ASSERT_EQ(topology.count(EdgeKind::kBoundary), 6u);
  int seams = 0;
  for (const Wedge& wedge : wedges(dihedral, topology, radians(10))) {
    if (wedge.triangles[1] == kNoIndex) continue;
    ++seams;
    EXPECT_NEAR(wedge.exterior_angle, radians(90), kRounding);
    for (std::uint32_t v : topology.edges[wedge.edge].vertices)
      EXPECT_NEAR(dihedral.vertices[v].xy().norm(), 0, kRounding);
  }
  EXPECT_EQ(seams, 1);
  for (std::size_t t = 0; t < dihedral.triangles.size(); ++t) EXPECT_GT(area_vector(dihedral, t).x(), 0);
}

TEST(TrihedralMesh, HasThreeFacesTowardsTheFirstOctant) {
  const double leg = 0.372;
  const TriangleMesh triangular = make_triangular_trihedral(leg), square = make_square_trihedral(leg);
  EXPECT_NEAR(surface_area(triangular), 1.5 * leg * leg, kRounding);
  EXPECT_NEAR(surface_area(square), 3.0 * leg * leg, kRounding);
  for (const TriangleMesh& mesh : {triangular, square}) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 area = area_vector(mesh, t);
      EXPECT_NEAR(area.maxCoeff(), area.norm(), kRounding) << "a face is not in a coordinate plane";
      sum += area;
    }
    EXPECT_NEAR((sum - Vec3::Constant(surface_area(mesh) / 3)).norm(), 0, kRounding);
    EXPECT_NEAR(mesh.vertices[0].norm(), 0, kRounding);
  }
}

TEST(SphereMesh, ConvergesToAreaAndVolumeInSecondOrder) {
  const double a = 0.7;
  double last_area = 0, last_volume = 0;
  for (int n = 2; n <= 5; ++n) {
    const TriangleMesh sphere = make_sphere(a, n);
    EXPECT_EQ(sphere.triangles.size(), 20u << (2 * n));
    for (const Vec3& p : sphere.vertices) EXPECT_NEAR(p.norm(), a, kRounding);
    const Topology topology = topology_of(sphere);
    EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size());
    EXPECT_TRUE(topology.part_closed[0]);
    const double area = 1 - surface_area(sphere) / (4 * kPi * a * a);
    const double volume = 1 - enclosed_volume(sphere) / (4.0 / 3.0 * kPi * a * a * a);
    EXPECT_GT(area, 0);
    EXPECT_GT(volume, 0);
    // Halving the edges quarters the deficit; the next order changes the ratio by less than the deficit itself, below 5
    // % here.
    if (n > 2) {
      EXPECT_NEAR(last_area / area, 4.0, 0.2);
      EXPECT_NEAR(last_volume / volume, 4.0, 0.2);
    }
    last_area = area;
    last_volume = volume;
  }
}

TEST(CylinderMesh, IsAClosedPrism) {
  const double a = 0.4, h = 1.5;
  const int n = 48;
  const TriangleMesh cylinder = make_cylinder(a, h, n);
  const double base = 0.5 * n * a * a * std::sin(2 * kPi / n);
  EXPECT_NEAR(enclosed_volume(cylinder), base * h, kRounding);
  EXPECT_NEAR(surface_area(cylinder), 2 * base + n * h * 2 * a * std::sin(kPi / n), kRounding);
  const Topology topology = topology_of(cylinder);
  EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size());
}

class Reflector : public testing::Test {
 protected:
  const double s = 0.526;
  const TriangleMesh mesh = make_icosahedral_reflector(s);
};

TEST_F(Reflector, IsAClosedSurfaceOfSixtyRightIsoscelesTriangles) {
  ASSERT_EQ(mesh.triangles.size(), 60u);
  ASSERT_EQ(mesh.vertices.size(), 32u);
  ASSERT_EQ(mesh.part_names.size(), 20u);
  const Topology topology = topology_of(mesh);
  EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size());
  EXPECT_TRUE(topology.degenerate.empty());
  for (const auto& [a, b, apex] : mesh.triangles) {
    const Vec3 p = mesh.vertices[a] - mesh.vertices[apex], q = mesh.vertices[b] - mesh.vertices[apex];
    EXPECT_NEAR(p.norm(), s / std::sqrt(2.0), kRounding);
    EXPECT_NEAR(q.norm(), s / std::sqrt(2.0), kRounding);
    EXPECT_NEAR(p.dot(q), 0, kRounding);
  }
}

TEST_F(Reflector, HasTheVolumeOfAnIcosahedronLessTwentyCorners) {
  const double solid = 5.0 / 12.0 * (3.0 + std::sqrt(5.0)) * s * s * s;
  const double corner = std::pow(s / std::sqrt(2.0), 3) / 6.0;
  EXPECT_NEAR(enclosed_volume(mesh), solid - 20 * corner, kRounding);
  EXPECT_NEAR(surface_area(mesh), 60 * 0.25 * s * s, kRounding);
}

TEST_F(Reflector, HasItsApexesAndRimsAtTheKnownRadii) {
  const double circumradius = 0.25 * std::sqrt(10.0 + 2.0 * std::sqrt(5.0)) * s;
  const double inradius = std::sqrt(3.0) / 12.0 * (3.0 + std::sqrt(5.0)) * s;
  for (const auto& [a, b, apex] : mesh.triangles) {
    EXPECT_NEAR(mesh.vertices[a].norm(), circumradius, kRounding);
    EXPECT_NEAR(mesh.vertices[apex].norm(), inradius - s / std::sqrt(6.0), kRounding);
  }
  EXPECT_NEAR(circumradius / s, 0.9511, 5e-5);
  EXPECT_NEAR(mesh.vertices[mesh.triangles[0][2]].norm() / s, 0.3475, 5e-5);
}

TEST_F(Reflector, FacesForwardWithItsFirstCellAndIsMirrorSymmetric) {
  const Vec3 apex = mesh.vertices[mesh.triangles[0][2]];
  EXPECT_NEAR((apex - Vec3(apex.norm(), 0, 0)).norm(), 0, kRounding);
  const Vec3 upper = mesh.vertices[mesh.triangles[0][0]];
  EXPECT_NEAR(upper.y(), 0, kRounding);
  EXPECT_GT(upper.z(), 0);
  for (const Vec3& p : mesh.vertices) {
    double nearest = 1;
    for (const Vec3& q : mesh.vertices) nearest = std::min(nearest, (q - Vec3(p.x(), -p.y(), p.z())).norm());
    EXPECT_NEAR(nearest, 0, kRounding);
  }
}

TEST(Generators, RefuseInvalidSizes) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (double bad : {0.0, -1.0, nan, inf}) {
    EXPECT_THROW(make_plate(bad, 1), InputError);
    EXPECT_THROW(make_plate(1, bad), InputError);
    EXPECT_THROW(make_dihedral(1, bad, 1), InputError);
    EXPECT_THROW(make_triangular_trihedral(bad), InputError);
    EXPECT_THROW(make_square_trihedral(bad), InputError);
    EXPECT_THROW(make_sphere(bad, 2), InputError);
    EXPECT_THROW(make_cylinder(1, bad, 8), InputError);
    EXPECT_THROW(make_icosahedral_reflector(bad), InputError);
  }
  EXPECT_THROW(make_dihedral(1, 1, kPi), InputError);
  EXPECT_THROW(make_sphere(1, 9), InputError);
  EXPECT_THROW(make_sphere(1, -1), InputError);
  EXPECT_THROW(make_cylinder(1, 1, 2), InputError);
}

}  // namespace
}  // namespace seaglint

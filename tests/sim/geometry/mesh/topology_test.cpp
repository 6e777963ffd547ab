// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/geometry/mesh_changes.h"

namespace seaglint {
namespace {

using namespace testing_meshes;

TriangleMesh unit_cube() { return box(Vec3::Zero(), Vec3::Constant(1)); }

TEST(Topology, OfACubeHasTwelveConvexRightWedges) {
  const TriangleMesh cube = unit_cube();
  EXPECT_NEAR(enclosed_volume(cube), 1.0, 1e-15);
  const Topology topology = topology_of(cube);
  EXPECT_EQ(topology.edges.size(), 18u);  // Euler: 8 - E + 12 = 2
  EXPECT_EQ(topology.count(EdgeKind::kManifold), 18u);
  EXPECT_TRUE(topology.part_closed[0]);
  const auto found = wedges(cube, topology, radians(5));
  ASSERT_EQ(found.size(), 12u);
  for (const Wedge& wedge : found) EXPECT_NEAR(wedge.exterior_angle, 1.5 * kPi, 1e-15);
}

TEST(Topology, OfACubeTurnedInsideOutHasConcaveWedges) {
  const TriangleMesh cube = turned_over(unit_cube());
  const Topology topology = topology_of(cube);
  EXPECT_TRUE(topology.part_closed[0]);
  for (const Wedge& wedge : wedges(cube, topology, radians(5))) EXPECT_NEAR(wedge.exterior_angle, 0.5 * kPi, 1e-15);
}

TEST(Topology, NeighboursReferToEachOther) {
  const TriangleMesh sphere = make_sphere(1, 2);
  const Topology topology = topology_of(sphere);
  for (std::uint32_t t = 0; t < sphere.triangles.size(); ++t) {
    for (std::uint32_t n : topology.neighbours[t]) {
      ASSERT_NE(n, kNoIndex);
      EXPECT_EQ(std::count(topology.neighbours[n].begin(), topology.neighbours[n].end(), t), 1);
    }
  }
}

TEST(Topology, CountsAHoleAndAFlippedTriangle) {
  TriangleMesh cube = unit_cube();
  std::swap(cube.triangles[0][1], cube.triangles[0][2]);
  EXPECT_EQ(topology_of(cube).count(EdgeKind::kInconsistent), 3u);
  EXPECT_FALSE(topology_of(cube).part_closed[0]);
  cube.triangles.erase(cube.triangles.begin());
  cube.triangle_part.pop_back();
  cube.triangle_material.pop_back();
  EXPECT_EQ(topology_of(cube).count(EdgeKind::kBoundary), 3u);
  EXPECT_FALSE(topology_of(cube).part_closed[0]);
}

TEST(Topology, AcceptsNonManifoldEdgesAndDegenerateTriangles) {
  MeshBuilder builder;
  builder.begin_part("fan");
  const auto a = builder.vertex({0, 0, 0}), b = builder.vertex({0, 0, 1});
  for (int i = 0; i < 5; ++i) builder.triangle(a, b, builder.vertex({std::cos(i), std::sin(i), 0.5}));
  const auto middle = builder.vertex({0, 0, 0.5});
  builder.triangle(a, b, middle);  // collinear
  builder.triangle(a, a, b);       // two vertices coincide
  const TriangleMesh fan = builder.take();
  const Topology topology = topology_of(fan);
  EXPECT_EQ(topology.count(EdgeKind::kNonManifold), 1u);
  EXPECT_EQ(topology.degenerate, (std::vector<std::uint32_t>{5, 6}));
  EXPECT_FALSE(topology.part_closed[0]);
  for (const Wedge& wedge : wedges(fan, topology, radians(5))) {
    EXPECT_LT(wedge.triangles[0], 5u);
    EXPECT_EQ(wedge.triangles[1], kNoIndex);
  }
}

TEST(Topology, TwoClosedPartsWithACommonEdgeAreEachClosed) {
  TriangleMesh first = unit_cube(), second = unit_cube();
  second.part_names = {"other"};
  const Mat3 half_turn(-Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ());
  first.append(transformed(second, half_turn, Vec3::Zero()));
  const TriangleMesh both = welded(first);
  EXPECT_EQ(both.vertices.size(), 14u);
  const Topology topology = topology_of(both);
  EXPECT_EQ(topology.count(EdgeKind::kNonManifold), 1u);
  EXPECT_TRUE(topology.part_closed[0]);
  EXPECT_TRUE(topology.part_closed[1]);
}

TEST(TriangleMesh, AppendMatchesPartsAndMaterialsByName) {
  TriangleMesh mesh = unit_cube();
  TriangleMesh other = unit_cube();
  other.part_names = {"mast"};
  other.materials = {Material{"paint"}};
  mesh.append(other);
  mesh.append(unit_cube());
  EXPECT_EQ(mesh.part_names, (std::vector<std::string>{"body", "mast"}));
  ASSERT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.triangle_part[12], 1);
  EXPECT_EQ(mesh.triangle_material[12], 1);
  EXPECT_EQ(mesh.triangle_part[24], 0);
  EXPECT_EQ(mesh.triangle_material[24], 0);
  EXPECT_NEAR(enclosed_volume(mesh), 3.0, 1e-12);
  EXPECT_EQ(part_of(mesh, 1).triangles.size(), 12u);
}

TEST(TriangleMesh, RotationAndTranslationKeepAreaAndVolume) {
  const TriangleMesh mesh = make_icosahedral_reflector();
  const Mat3 R = axis_rotation(0.7, Vec3(1, 2, 3).normalized());
  const TriangleMesh moved = transformed(mesh, R, Vec3(10, -5, 2));
  EXPECT_NEAR(enclosed_volume(moved), enclosed_volume(mesh), 1e-12);
  EXPECT_NEAR(surface_area(moved), surface_area(mesh), 1e-12);
}

TEST(TriangleMesh, WeldingMakesASoupOfTrianglesClosedAgain) {
  const TriangleMesh sphere = make_sphere(1, 1);
  const TriangleMesh loose = split_vertices(sphere);
  EXPECT_FALSE(topology_of(loose).part_closed[0]);
  const TriangleMesh mesh = welded(loose);
  EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size());
  EXPECT_TRUE(topology_of(mesh).part_closed[0]);
}

TEST(TriangleMesh, BoundsIgnoreVerticesWithoutTriangles) {
  TriangleMesh mesh = unit_cube();
  mesh.vertices.push_back({100, 0, 0});
  EXPECT_EQ(bounds(mesh).upper.x(), 1.0);
  EXPECT_EQ(bounds(TriangleMesh{}).upper.x(), 0.0);
}

// Triangles of 20 vertices, some of which coincide.
std::vector<std::array<std::uint32_t, 3>> random_triangles(std::size_t count) {
  std::minstd_rand random(1);
  std::vector<std::array<std::uint32_t, 3>> triangles(count);
  for (auto& triangle : triangles) {
    for (std::uint32_t& v : triangle) v = static_cast<std::uint32_t>(random() % 20);
  }
  return triangles;
}

TEST(IndexGroups, HoldEveryIndexInItsGroupInAscendingOrder) {
  const auto triangles = random_triangles(200);
  const IndexGroups groups(triangles.size(), 25, [&](std::uint32_t t) { return triangles[t][0]; });
  ASSERT_EQ(groups.size(), 25u);
  for (std::size_t group = 0; group < groups.size(); ++group) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (triangles[t][0] == group) expected.push_back(t);
    }
    EXPECT_TRUE(std::ranges::equal(groups[group], expected)) << group;
  }
}

TEST(Topology, SidesAreSortedByEdgeThenTriangle) {
  const auto triangles = random_triangles(200);
  std::vector<std::array<std::uint32_t, 4>> expected, found;  // vertices, triangle, side
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
      if (low != high) expected.push_back({low, high, t, i});
    }
  }
  std::ranges::sort(expected);
  for (const auto& [vertices, side] : sides_by_edge(triangles, 20)) {
    found.push_back({vertices[0], vertices[1], side.triangle, side.side});
    EXPECT_EQ(side.forward, triangles[side.triangle][side.side] == vertices[0]);
  }
  EXPECT_EQ(found, expected);
}

TEST(Welding, VerticesAtOnePositionHaveTheIndexOfTheFirst) {
  std::minstd_rand random(2);
  std::vector<Vec3> vertices;
  for (int i = 0; i < 300; ++i) {
    Vec3 x;
    for (double& coordinate : x) coordinate = static_cast<double>(random() % 4);
    vertices.push_back(i % 2 == 0 ? x : Vec3(-0.0 - x.x(), x.y(), x.z()));
  }
  const std::vector<std::uint32_t> first = first_at_position(vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    EXPECT_EQ(first[i], std::ranges::find(vertices, vertices[i]) - vertices.begin()) << i;
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/mesh/triangulate_polygon.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/geometry/mesh_changes.h"

namespace seaglint {
namespace {

using Corners = std::vector<Vec3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using namespace testing_meshes;

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
  TriangleMesh mesh = unit_cube(), other = unit_cube();
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
  const TriangleMesh sphere = make_sphere(1, 1), loose = split_vertices(sphere);
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
  for (auto& triangle : triangles)
    for (std::uint32_t& v : triangle) v = static_cast<std::uint32_t>(random() % 20);
  return triangles;
}

TEST(IndexGroups, HoldEveryIndexInItsGroupInAscendingOrder) {
  const auto triangles = random_triangles(200);
  const IndexGroups groups(triangles.size(), 25, [&](std::uint32_t t) { return triangles[t][0]; });
  ASSERT_EQ(groups.size(), 25u);
  for (std::size_t group = 0; group < groups.size(); ++group) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      if (triangles[t][0] == group) expected.push_back(t);
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

// A polygon's triangles cover it once: all have its orientation, and their areas sum to its own.

Corners flat(const std::vector<std::array<double, 2>>& points) {
  Corners corners;
  for (const auto& [x, y] : points) corners.push_back({x, y, 0});
  return corners;
}

const Corners kL = flat({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
const Corners kU = flat({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
const Corners kCollinear = flat({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 1.5}, {1, 2}, {0, 2}, {0, 1}});
// A square within a square, connected by a slit: vertices 0 and 5, 4 and 9 coincide.
const Corners kKeyhole = flat({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}});

Corners star(int points) {
  Corners corners;
  for (int i = 0; i < 2 * points; ++i) {
    const double r = i % 2 == 0 ? 1 : 0.3;
    corners.push_back({r * std::cos(i * kPi / points), r * std::sin(i * kPi / points), 0});
  }
  return corners;
}

// A spiral band: outwards along one side, back along the other.
Corners spiral(int steps) {
  Corners corners;
  for (const bool back : {false, true}) {
    for (int i = 0; i <= steps; ++i) {
      const double angle = 6 * kPi * (back ? steps - i : i) / steps, r = 10 - angle / 2.5 - (back ? 0.8 : 0);
      corners.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
  }
  return corners;
}

Vec3 area_of(const Corners& corner) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < corner.size(); ++i) sum += corner[i].cross(corner[(i + 1) % corner.size()]) / 2;
  return sum;
}

void expect_covers(const Corners& corner, double area) {
  const auto triangles = triangulate_polygon(corner);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), corner.size() - 2);
  const Vec3 normal = area_of(corner).normalized();
  double sum = 0;
  for (const auto& [a, b, c] : *triangles) {
    ASSERT_LT(std::max({a, b, c}), corner.size());
    const double part = (corner[b] - corner[a]).cross(corner[c] - corner[a]).dot(normal) / 2;
    EXPECT_GE(part, -1e-12);
    sum += std::abs(part);
  }
  EXPECT_NEAR(sum, area, 1e-12 * static_cast<double>(corner.size()));
}

// From every first vertex, in both orientations, seen from any side and away from the origin.
void expect_covers_however_written(Corners corner, double area) {
  const Mat3 R = axis_rotation(1.1, Vec3(1, -2, 0.5).normalized());
  for (std::size_t start = 0; start < corner.size(); ++start) {
    SCOPED_TRACE("from corner " + std::to_string(start));
    std::rotate(corner.begin(), corner.begin() + 1, corner.end());
    expect_covers(corner, area);
    expect_covers(Corners(corner.rbegin(), corner.rend()), area);
    Corners rotated;
    for (const Vec3& p : corner) rotated.push_back(R * p + Vec3(3, 4, -2));
    expect_covers(rotated, area);
  }
}

TEST(PolygonTriangulation, CoversConcaveShapesFromAnyFirstVertex) {
  expect_covers_however_written(kL, 3);
  expect_covers_however_written(kU, 7);
  expect_covers_however_written(kCollinear, 3);
  expect_covers_however_written(kKeyhole, 8);
  expect_covers_however_written(star(5), area_of(star(5)).norm());
  expect_covers_however_written(spiral(40), area_of(spiral(40)).norm());
}

TEST(PolygonTriangulation, KeepsTheFanOfConvexOnes) {
  Corners round;
  for (int i = 0; i < 9; ++i) round.push_back({7 + std::cos(i * kPi / 4.5), 3 * std::sin(i * kPi / 4.5), 1});
  for (const Corners& corner :
       {flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), flat({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0.5}}), round}) {
    Triangles fan;
    for (std::uint32_t i = 1; i + 1 < corner.size(); ++i) fan.push_back({0, i, i + 1});
    EXPECT_EQ(triangulate_polygon(corner), fan);
  }
}

TEST(PolygonTriangulation, KeepsTheFanOfPolygonsThatItCovers) {
  Corners corner = kL;  // from its concave vertex
  std::rotate(corner.begin(), corner.begin() + 3, corner.end());
  EXPECT_EQ(triangulate_polygon(corner), (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
}

TEST(PolygonTriangulation, ProjectsNonPlanarVerticesOntoThePlaneOfTheArea) {
  Corners corner = kL;
  for (std::size_t i = 0; i < corner.size(); ++i) corner[i].z() = i % 2 == 0 ? 0.1 : -0.1;
  const auto triangles = triangulate_polygon(corner);
  ASSERT_TRUE(triangles);
  Vec3 sum = Vec3::Zero();
  for (const auto& [a, b, c] : *triangles) {
    const Vec3 part = (corner[b] - corner[a]).cross(corner[c] - corner[a]) / 2;
    EXPECT_GT(part.z(), 0);
    sum += part;
  }
  EXPECT_LT((sum - area_of(corner)).norm(), 1e-12);
}

TEST(PolygonTriangulation, FansPolygonsWithoutArea) {
  EXPECT_EQ(triangulate_polygon(flat({{0, 0}, {1, 0}, {3, 0}, {2, 0}}))->size(), 2u);
  EXPECT_EQ(triangulate_polygon(flat({{0, 0}, {0, 0}, {0, 0}, {0, 0}}))->size(), 2u);
}

TEST(PolygonTriangulation, TriangulatesThousandsOfVerticesAndNoMore) {
  const Corners most = spiral(static_cast<int>(kMaxConcaveVertices) / 2 - 1),
                more = spiral(static_cast<int>(kMaxConcaveVertices) / 2);
  ASSERT_EQ(most.size(), kMaxConcaveVertices);
  expect_covers(most, area_of(most).norm());
  EXPECT_FALSE(triangulate_polygon(more));
  Corners round;
  for (int i = 0; i < 10000; ++i) round.push_back({std::cos(i * 2e-4 * kPi), std::sin(i * 2e-4 * kPi), 0});
  EXPECT_EQ(triangulate_polygon(round)->size(), 9998u);
}

TEST(PolygonTriangulation, RefusesSelfIntersectingPolygons) {
  EXPECT_FALSE(triangulate_polygon(flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}})));
  EXPECT_FALSE(triangulate_polygon(flat({{0, 0}, {1, 1}, {1, 0}, {0, 3}})));
  Corners pentagram;
  for (int i = 0; i < 5; ++i) pentagram.push_back({std::cos(i * 0.8 * kPi), std::sin(i * 0.8 * kPi), 0});
  EXPECT_FALSE(triangulate_polygon(pentagram));
}

}  // namespace
}  // namespace seaglint

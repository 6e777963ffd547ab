// SPDX-License-Identifier: BSD-3-Clause
// A polygon's triangles cover it once: all have its orientation, and their areas sum to its own.
#include "sim/geometry/mesh/triangulate_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"

namespace seaglint {
namespace {

using Corners = std::vector<Vec3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

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

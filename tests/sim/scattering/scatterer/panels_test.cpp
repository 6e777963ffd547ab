// SPDX-License-Identifier: BSD-3-Clause
// Panels: facets of one plane joined to convex polygons.
#include "sim/scattering/scatterer/panels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

double area_of(std::span<const Vec3> outline, const Vec3& normal) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    twice += (outline[i] - outline[0]).cross(outline[i + 1] - outline[0]).dot(normal);
  }
  return twice / 2;
}

TEST(Panels, JoinTheTwoTrianglesOfAPlate) {
  const auto facets = make_facets(make_plate(0.3, 0.2));
  const Panels panels(facets);
  ASSERT_EQ(panels.outline(0).size(), 4u);
  EXPECT_TRUE(panels.outline(1).empty());
  EXPECT_EQ(panels.representative(1), 0);
  EXPECT_EQ(panels.members(0).size(), 2u);
  EXPECT_NEAR(panels.size(0), std::hypot(0.3, 0.2), 1e-15);
}

TEST(Panels, OfTheShipAreConvexLieInOnePlaneAndKeepItsArea) {
  const auto facets = make_facets(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb"));
  const Panels panels(facets);
  std::vector<int> memberships(facets.size(), 0);
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    if (!panels.is_representative(f)) continue;
    const auto outline = panels.outline(f);
    double area = 0;
    for (const int member : panels.members(f)) {
      ++memberships[member];
      EXPECT_EQ(panels.representative(member), f);
      EXPECT_EQ(facets[member].part, facets[f].part);
      area += area_of(facets[member].corner, facets[f].normal);
      for (const Vec3& x : facets[member].corner) EXPECT_LT(std::abs(facets[f].normal.dot(x) - facets[f].offset), 1e-7);
    }
    EXPECT_NEAR(area_of(outline, facets[f].normal), area, 1e-10 * area + 1e-12);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()], &c = outline[(i + 2) % outline.size()];
      EXPECT_GT((b - a).cross(c - b).dot(facets[f].normal), 0) << f;
    }
  }
  EXPECT_EQ(std::count(memberships.begin(), memberships.end(), 1), static_cast<std::ptrdiff_t>(facets.size()))
      << "every facet in one panel";
}

TEST(Panels, AreSeparateWhereMaterialOrPlaneChanges) {
  TriangleMesh mesh = make_plate(0.3, 0.2);
  auto facets = make_facets(mesh);
  facets[1].material = 1;
  EXPECT_TRUE(Panels(facets).is_representative(1));
  mesh.vertices[mesh.triangles[1][1]].x() += 1e-5;
  mesh.vertices[mesh.triangles[1][2]].x() += 1e-5;
  mesh.vertices[mesh.triangles[0][0]].x() -= 1e-5;
  EXPECT_EQ(Panels(make_facets(mesh)).outline(0).size(), 3u);
}

}  // namespace
}  // namespace seaglint

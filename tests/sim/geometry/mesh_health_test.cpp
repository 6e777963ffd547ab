// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh_health.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/geometry/generators.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void flip(TriangleMesh& mesh, std::size_t triangle) { std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]); }

void add(TriangleMesh& mesh, std::array<std::uint32_t, 3> triangle) {
  mesh.triangles.push_back(triangle);
  mesh.triangle_part.push_back(0);
  mesh.triangle_material.push_back(0);
}

TEST(MeshHealth, HasNothingToSayOfAClosedMesh) {
  for (const TriangleMesh& mesh : {make_sphere(1, 2), make_icosahedral_reflector(), make_cylinder(1, 2, 12)}) {
    EXPECT_THAT(findings(examine(mesh)), ElementsAre());
    EXPECT_EQ(repaired(mesh).triangles, mesh.triangles);
  }
}

TEST(MeshHealth, TurnsAClosedSurfaceThatIsInsideOut) {
  const TriangleMesh sphere = make_sphere(1, 1);
  TriangleMesh inverted = transformed(sphere, Mat3::Identity(), Vec3(0, 0, 50));
  for (std::size_t t = 0; t < inverted.triangles.size(); ++t) flip(inverted, t);
  TriangleMesh both = sphere;  // a sound one beside it stays
  both.append(inverted);
  const MeshHealth health = examine(both);
  EXPECT_EQ(health.surfaces, 2u);
  EXPECT_EQ(health.inverted_surfaces, 1u);
  EXPECT_EQ(health.inverted_triangles, 80u);
  EXPECT_THAT(findings(health), ElementsAre(HasSubstr("1 closed surface is inside out (80 triangles)")));
  const TriangleMesh turned = repaired(both);
  EXPECT_EQ(examine(turned).inverted_surfaces, 0u);
  EXPECT_NEAR(enclosed_volume(turned), 2 * enclosed_volume(sphere), 1e-9);
}

TEST(MeshHealth, CountsHolesAndTrianglesThatFaceTheOtherWay) {
  TriangleMesh holed = make_sphere(1, 1);
  holed.triangles.pop_back();
  holed.triangle_part.pop_back();
  holed.triangle_material.pop_back();
  EXPECT_EQ(examine(holed).open_edges, 3u);
  EXPECT_THAT(findings(examine(holed)), ElementsAre(HasSubstr("3 open edges; 1 of 1 surfaces are open")));
  TriangleMesh mixed = make_sphere(1, 1);
  flip(mixed, 7);
  EXPECT_EQ(examine(mixed).mixed_edges, 3u);
  EXPECT_EQ(examine(mixed).inverted_surfaces, 0u);
  EXPECT_THAT(findings(examine(mixed)), ElementsAre(HasSubstr("3 edges have neighbours that face opposite ways")));
}

TEST(MeshHealth, LeavesOutRepeatedAndDegenerateTriangles) {
  const TriangleMesh sphere = make_sphere(1, 1);
  TriangleMesh dirty = sphere;
  const auto [a, b, c] = sphere.triangles[5];
  add(dirty, {b, c, a});  // the same triangle, begun elsewhere
  add(dirty, {a, a, b});
  const MeshHealth health = examine(dirty);
  EXPECT_EQ(health.repeated, 1u);
  EXPECT_EQ(health.degenerate, 1u);
  EXPECT_EQ(health.open_surfaces, 0u);
  EXPECT_THAT(findings(health), ElementsAre(HasSubstr("1 triangle has no area"), HasSubstr("1 triangle repeats another")));
  EXPECT_EQ(repaired(dirty).triangles, sphere.triangles);
}

TEST(MeshHealth, LeavesOneSideOfSheetsOfTwo) {
  const TriangleMesh sheet = make_plate(1, 1);
  TriangleMesh two_sided = sheet;
  for (const auto& t : sheet.triangles) add(two_sided, {t[0], t[2], t[1]});
  const MeshHealth health = examine(two_sided);
  EXPECT_EQ(health.two_sided, 2u);
  EXPECT_EQ(health.open_edges, 4u);
  EXPECT_THAT(findings(health), ElementsAre(HasSubstr("4 open edges"), HasSubstr("2 triangles are the back of another")));
  EXPECT_EQ(repaired(two_sided).triangles, sheet.triangles);
}

TEST(MeshHealth, CountsEdgesOfThreeTriangles) {
  TriangleMesh fin = make_plate(1, 1);
  fin.vertices.push_back({1, 0, 0});
  add(fin, {fin.triangles[0][0], fin.triangles[0][2], static_cast<std::uint32_t>(fin.vertices.size() - 1)});  // on the diagonal
  EXPECT_EQ(examine(fin).non_manifold_edges, 1u);
}

}  // namespace
}  // namespace seaglint

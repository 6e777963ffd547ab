// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/mesh_diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/geometry/mesh_changes.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void add(TriangleMesh& mesh, std::array<std::uint32_t, 3> triangle) {
  mesh.triangles.push_back(triangle);
  mesh.triangle_part.push_back(0);
  mesh.triangle_material.push_back(0);
}

TEST(MeshDiagnostics, AreEmptyForAClosedMesh) {
  for (const TriangleMesh& mesh : {make_sphere(1, 2), make_icosahedral_reflector(), make_cylinder(1, 2, 12)}) {
    EXPECT_THAT(diagnostic_messages(diagnose(mesh)), ElementsAre());
    EXPECT_EQ(repair(mesh).triangles, mesh.triangles);
  }
}

TEST(MeshDiagnostics, AndRepairAreTheSameAtOnce) {
  TriangleMesh mesh = make_sphere(1, 2);
  mesh = testing_meshes::turned_over(mesh);
  add(mesh, mesh.triangles[5]);
  add(mesh, {7, 7, 8});
  const RepairedMesh repaired = diagnose_and_repair(mesh);
  EXPECT_EQ(diagnostic_messages(repaired.health), diagnostic_messages(diagnose(mesh)));
  EXPECT_EQ(diagnostic_messages(repaired.health).size(), 3u);
  EXPECT_EQ(repaired.mesh.triangles, repair(mesh).triangles);
  EXPECT_EQ(repaired.mesh.triangles, make_sphere(1, 2).triangles);
}

TEST(MeshDiagnostics, InvertAClosedSurfaceThatIsInsideOut) {
  const TriangleMesh sphere = make_sphere(1, 1);
  const TriangleMesh inverted = testing_meshes::turned_over(transformed(sphere, Mat3::Identity(), Vec3(0, 0, 50)));
  TriangleMesh both = sphere;  // a valid one next to it is not changed
  both.append(inverted);
  const MeshDiagnostics health = diagnose(both);
  EXPECT_EQ(health.surfaces, 2u);
  EXPECT_EQ(health.inverted_surfaces, 1u);
  EXPECT_EQ(health.inverted_triangles, 80u);
  EXPECT_THAT(diagnostic_messages(health), ElementsAre(HasSubstr("1 closed surface is inside out (80 triangles)")));
  const TriangleMesh repaired = repair(both);
  EXPECT_EQ(diagnose(repaired).inverted_surfaces, 0u);
  EXPECT_NEAR(enclosed_volume(repaired), 2 * enclosed_volume(sphere), 1e-9);
}

TEST(MeshDiagnostics, CountHolesAndInconsistentTriangles) {
  TriangleMesh holed = make_sphere(1, 1);
  holed.triangles.pop_back();
  holed.triangle_part.pop_back();
  holed.triangle_material.pop_back();
  EXPECT_EQ(diagnose(holed).open_edges, 3u);
  EXPECT_THAT(diagnostic_messages(diagnose(holed)), ElementsAre(HasSubstr("3 open edges; 1 of 1 surfaces are open")));
  TriangleMesh mixed = make_sphere(1, 1);
  std::swap(mixed.triangles[7][1], mixed.triangles[7][2]);
  EXPECT_EQ(diagnose(mixed).inconsistent_edges, 3u);
  EXPECT_EQ(diagnose(mixed).inverted_surfaces, 0u);
  EXPECT_THAT(diagnostic_messages(diagnose(mixed)),
              ElementsAre(HasSubstr("3 edges have neighbours of opposite orientation")));
}

TEST(MeshDiagnostics, RemoveRepeatedAndDegenerateTriangles) {
  const TriangleMesh sphere = make_sphere(1, 1);
  TriangleMesh dirty = sphere;
  const auto [a, b, c] = sphere.triangles[5];
  add(dirty, {b, c, a});  // the same triangle from another first vertex
  add(dirty, {a, a, b});
  const MeshDiagnostics health = diagnose(dirty);
  EXPECT_EQ(health.repeated, 1u);
  EXPECT_EQ(health.degenerate, 1u);
  EXPECT_EQ(health.open_surfaces, 0u);
  EXPECT_THAT(diagnostic_messages(health),
              ElementsAre(HasSubstr("1 triangle has no area"), HasSubstr("1 triangle repeats another")));
  EXPECT_EQ(repair(dirty).triangles, sphere.triangles);
}

TEST(MeshDiagnostics, KeepOneSideOfTwoSidedSheets) {
  const TriangleMesh sheet = make_plate(1, 1);
  TriangleMesh two_sided = sheet;
  for (const auto& t : sheet.triangles) add(two_sided, {t[0], t[2], t[1]});
  const MeshDiagnostics health = diagnose(two_sided);
  EXPECT_EQ(health.two_sided, 2u);
  EXPECT_EQ(health.open_edges, 4u);
  EXPECT_THAT(
      diagnostic_messages(health),
      ElementsAre(HasSubstr("4 open edges"), HasSubstr("2 triangles duplicate others with opposite orientation")));
  EXPECT_EQ(repair(two_sided).triangles, sheet.triangles);
}

// A plate whose back is a part with a material of its own, in either order.
TriangleMesh plate_of_two_materials(bool front_first) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.part_names = {"front", "back"};
  mesh.materials = {Material{"pec"}, Material{"canvas"}};
  const auto front = mesh.triangles;
  for (const auto& t : front) add(mesh, {t[0], t[2], t[1]});
  mesh.triangle_part = mesh.triangle_material = {0, 0, 1, 1};
  if (!front_first) {
    std::rotate(mesh.triangles.begin(), mesh.triangles.begin() + 2, mesh.triangles.end());
    mesh.triangle_part = mesh.triangle_material = {1, 1, 0, 0};
  }
  return mesh;
}

TEST(MeshDiagnostics, KeepBothSidesOfASheetOfTwoMaterials) {
  for (const bool front_first : {true, false}) {
    TriangleMesh mesh = plate_of_two_materials(front_first);
    EXPECT_EQ(diagnose(mesh).kept_backs, 2u);
    EXPECT_EQ(diagnose(mesh).open_surfaces, 0u);
    EXPECT_EQ(repair(mesh).triangles, mesh.triangles);
    EXPECT_EQ(repair(mesh).triangle_material, mesh.triangle_material);
    add(mesh, mesh.triangles[2]);  // a second copy of the later side
    EXPECT_EQ(repair(mesh).triangles.size(), 4u);
    mesh.triangle_material.assign(5, 0);
    EXPECT_EQ(repair(mesh).triangles.size(), 2u) << "parts of one material are one sheet";
  }
}

TEST(MeshDiagnostics, NameTheRemovedSideOfAnOpenSurface) {
  TriangleMesh mesh = plate_of_two_materials(true);
  mesh.vertices.push_back({1, 0, 0});
  // a fin of one side
  add(mesh, {mesh.triangles[0][0], mesh.triangles[0][1], static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
  EXPECT_EQ(diagnose(mesh).dropped_backs, 2u);
  EXPECT_THAT(diagnostic_messages(diagnose(mesh)),
              testing::Contains(HasSubstr("2 triangles are the back of another in another material, the first of them "
                                          "of part 'back' behind part 'front'")));
  EXPECT_EQ(repair(mesh).triangles.size(), 3u);
}

TEST(MeshDiagnostics, CountEdgesOfThreeTriangles) {
  TriangleMesh fin = make_plate(1, 1);
  fin.vertices.push_back({1, 0, 0});
  // on the diagonal
  add(fin, {fin.triangles[0][0], fin.triangles[0][2], static_cast<std::uint32_t>(fin.vertices.size() - 1)});
  EXPECT_EQ(diagnose(fin).non_manifold_edges, 1u);
}

TriangleMesh cube_at(const Vec3& lower) { return testing_meshes::box(lower, lower + Vec3::Constant(1)); }

TEST(MeshDiagnostics, TreatBodiesThatTouchAlongAnEdgeSeparately) {
  const TriangleMesh first = cube_at(Vec3::Zero()), second = cube_at({1, 1, 0});
  ASSERT_NEAR(enclosed_volume(first), 1, 1e-12);
  for (const bool larger_first : {true, false}) {
    const TriangleMesh inverted = testing_meshes::turned_over(second);
    TriangleMesh both = larger_first ? first : inverted;
    both.append(larger_first ? inverted : first);
    both = welded(both);
    const MeshDiagnostics health = diagnose(both);
    EXPECT_EQ(health.non_manifold_edges, 1u);
    EXPECT_EQ(health.surfaces, 2u);
    EXPECT_EQ(health.open_surfaces, 0u);
    EXPECT_EQ(health.inverted_triangles, 12u);
    EXPECT_NEAR(enclosed_volume(repair(both)), 2, 1e-12);
  }
}

// Two caps and two discs between them on one ring of edges: none is closed alone, all together are the surface of a
// hollow body.
TEST(MeshDiagnostics, TreatPiecesThatCloseOnlyTogetherAsOne) {
  MeshBuilder builder;
  for (int i = 0; i < 4; ++i) builder.vertex({std::cos(i * kPi / 2), std::sin(i * kPi / 2), 0});
  for (const double z : {1.0, -1.0, 0.2, -0.2}) builder.vertex({0, 0, z});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    builder.triangle(i, next, 4), builder.triangle(next, i, 5), builder.triangle(next, i, 6),
        builder.triangle(i, next, 7);
  }
  TriangleMesh mesh = builder.take();
  const double volume = enclosed_volume(mesh);
  ASSERT_GT(volume, 1.0);
  EXPECT_THAT(diagnostic_messages(diagnose(mesh)), ElementsAre(HasSubstr("4 edges have three triangles or more")));
  mesh = testing_meshes::turned_over(mesh);
  EXPECT_EQ(diagnose(mesh).inverted_triangles, 16u);
  EXPECT_NEAR(enclosed_volume(repair(mesh)), volume, 1e-12);
}

TEST(MeshDiagnostics, ReportAPartitionInsideABody) {
  TriangleMesh divided = cube_at(Vec3::Zero());
  // a slanting wall from edge to edge
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 1, 7}, {0, 7, 6}}) add(divided, t);
  const MeshDiagnostics health = diagnose(divided);
  EXPECT_EQ(health.open_edges, 0u);
  EXPECT_EQ(health.non_manifold_surfaces, 1u);
  EXPECT_THAT(diagnostic_messages(health),
              ElementsAre(HasSubstr("1 surface that branches there: no telling which side is inside")));
}

}  // namespace
}  // namespace seaglint

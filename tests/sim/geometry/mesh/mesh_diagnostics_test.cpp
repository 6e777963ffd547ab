// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/geometry/mesh_changes.h"

namespace seaglint {
namespace {

using namespace testing_meshes;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Sheets that are drawn from both sides, with either side cut otherwise.

const std::string kMeshes = SEAGLINT_SOURCE_DIR "/tests/cases/meshes/";

TriangleMesh both(TriangleMesh first, const TriangleMesh& second) {
  first.append(second);
  return welded(first);
}

// A rectangle in the plane z = height, upwards.
TriangleMesh deck(double from_x, double to_x, double from_y, double to_y, double height = 0) {
  MeshBuilder builder;
  builder.quad(builder.vertex({from_x, from_y, height}), builder.vertex({to_x, from_y, height}),
               builder.vertex({to_x, to_y, height}), builder.vertex({from_x, to_y, height}));
  return builder.take();
}

// A surface of quads x(i/n, j/n), drawn from both sides as programs do that write every polygon twice: the fan of the
// reversed polygon has the other diagonal.
TriangleMesh quads_from_both_sides(std::uint32_t n, const std::function<Vec3(double, double)>& x, bool backs = true) {
  MeshBuilder builder;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) builder.vertex(x(1.0 * i / n, 1.0 * j / n));
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      builder.quad(a, b, c, d);
      if (backs) builder.quad(d, c, b, a);
    }
  }
  return welded(builder.take());
}

TEST(CoincidingFaces, AreOneSheetHoweverTheBacksAreCut) {
  const TriangleMesh sheet = read_mesh(kMeshes + "trihedral_sheet.obj"),
                     drawn_twice = read_mesh(kMeshes + "trihedral_two_sided.obj");
  EXPECT_THAT(diagnostic_messages(diagnose(drawn_twice)),
              Contains("6 triangles coincide with others with opposite orientation, cut otherwise (3 m^2): removed; "
                       "coinciding faces are one sheet, which scatters from both sides"));
  EXPECT_EQ(repair(drawn_twice).triangles, sheet.triangles);

  const TriangleMesh plate = quads_from_both_sides(1, [](double u, double v) { return Vec3(0, u, v); });
  EXPECT_EQ(diagnose(plate).covered, 2u);
  EXPECT_EQ(diagnose(plate).partly, 0u);

  Random random({7, Stream::kTest, 1});
  TriangleMesh backs = turned_over(sheet);
  for (int level = 0; level < 4; ++level) {
    const MeshDiagnostics health = diagnose(both(sheet, backs));
    EXPECT_EQ(health.covered + health.two_sided, backs.triangles.size()) << level;
    EXPECT_EQ(repair(both(sheet, backs)).triangles.size(), sheet.triangles.size()) << level;
    EXPECT_NEAR(surface_area(repair(both(backs, sheet))), 3, 1e-12) << level;
    backs = renumbered(cut_in_four(backs), random);
  }
}

// Float32 rounds the corners of the cuts, and six digits those of a file.
TEST(CoincidingFaces, MayDifferByTheRoundingOfTheirCorners) {
  Mat3 R = axis_rotation(0.7, Vec3(1, 2, 3).normalized());
  const TriangleMesh sheet = transformed(make_plate(3, 2), R, {20, 30, 5});
  const TriangleMesh backs = cut_in_four(cut_in_four(turned_over(sheet), true), true);
  EXPECT_EQ(diagnose(both(sheet, backs)).covered, backs.triangles.size());
  // Plates of 1 mm are bodies.
  const TriangleMesh plate = box({0, 0, 0}, {3, 2, 1e-3});
  EXPECT_EQ(diagnose(plate).covered, 0u);
  EXPECT_THAT(diagnostic_messages(diagnose(plate)), IsEmpty());
}

TEST(CoincidingFaces, OfASmallerBackAreThePanelAlone) {
  const TriangleMesh panel = deck(0, 4, 0, 2), small = turned_over(both(deck(1, 2, 0.5, 1.5), deck(2, 3, 0.5, 1)));
  for (const TriangleMesh& mesh : {both(panel, small), both(small, panel)}) {
    EXPECT_EQ(diagnose(mesh).covered, 4u);
    EXPECT_NEAR(surface_area(repair(mesh)), 8, 1e-12);
    EXPECT_EQ(repair(mesh).triangles.size(), 2u);
  }
}

TEST(CoincidingFaces, InPartAreNamed) {
  const TriangleMesh mesh = both(deck(0, 2, 0, 1), turned_over(deck(1, 3, 0, 1)));
  EXPECT_EQ(repair(mesh).triangles.size(), 4u);
  EXPECT_NEAR(diagnose(mesh).partly_m2, 1, 1e-9);
  EXPECT_THAT(diagnostic_messages(diagnose(mesh)),
              Contains(HasSubstr("4 triangles overlap others with opposite orientation in part (1 m^2)")));
  // Side by side, or touching at an edge, is no overlap.
  EXPECT_EQ(diagnose(both(deck(0, 2, 0, 1), turned_over(deck(2, 3, 0, 1)))).partly, 0u);
}

TEST(CoincidingFaces, OfBodiesInContactStay) {
  const TriangleMesh hull = cut_in_four(box({-4, -2, -1}, {4, 2, 0})), house = box({-1, -1, 0}, {1, 1, 1.5});
  for (const TriangleMesh& mesh : {both(hull, house), both(house, hull)}) {
    EXPECT_EQ(repair(mesh).triangles.size(), mesh.triangles.size());
    EXPECT_EQ(diagnose(mesh).open_surfaces, 0u);
    EXPECT_THAT(diagnostic_messages(diagnose(mesh)), IsEmpty());
  }
  // A sheet against a body: the body stays closed, the sheet is kept where the body ends.
  const TriangleMesh under = turned_over(deck(-1.5, 1.5, -1, 1)), beyond = turned_over(deck(-6, 6, -3, 3));
  EXPECT_EQ(repair(both(under, hull)).triangles.size(), hull.triangles.size());
  EXPECT_EQ(diagnose(both(under, hull)).open_surfaces, 0u);
  EXPECT_EQ(repair(both(beyond, hull)).triangles.size(), hull.triangles.size() + 2);
}

// Both drawn from both sides: the backs go, the bodies and their contact stay.
TEST(CoincidingFaces, OfBodiesInContactThatAreDrawnFromBothSidesTooLeaveThemClosed) {
  const auto drawn_twice = [](const TriangleMesh& body) {
    TriangleMesh mesh = body;
    for (std::size_t t = 0; t < body.triangles.size(); t += 2) {  // a b c, a c d: d c b, d b a
      const auto [a, b, c] = body.triangles[t];
      const std::uint32_t d = body.triangles[t + 1][2];
      mesh.triangles.insert(mesh.triangles.end(), {{d, c, b}, {d, b, a}});
    }
    mesh.triangle_part.assign(mesh.triangles.size(), 0);
    mesh.triangle_material.assign(mesh.triangles.size(), 0);
    return mesh;
  };
  const TriangleMesh hull = box({-4, -2, -1}, {4, 2, 0}), house = box({-1, -1, 0}, {1, 1, 1.5});
  const TriangleMesh mesh = repair(both(drawn_twice(hull), drawn_twice(house)));
  EXPECT_EQ(mesh.triangles.size(), 24u);
  EXPECT_EQ(diagnose(mesh).open_surfaces, 0u);
  EXPECT_NEAR(enclosed_volume(mesh), 32 + 6, 1e-12);
}

// The quads of a saddle are warped: the two fans of a quad enclose a thin tetrahedron.
TEST(CoincidingFaces, OfWarpedQuadsAreOneSheet) {
  const auto saddle = [](double u, double v) { return Vec3(u, v, 0.4 * (u - 0.5) * (v - 0.3)); };
  const TriangleMesh mesh = quads_from_both_sides(5, saddle);
  EXPECT_EQ(diagnose(mesh).covered, 50u);
  EXPECT_EQ(repair(mesh).triangles, quads_from_both_sides(5, saddle, false).triangles);
  // A tetrahedron is a body.
  EXPECT_EQ(repair(quads_from_both_sides(1, [](double u, double v) { return Vec3(u, v, u * v); })).triangles.size(),
            4u);
}

TEST(CoincidingFaces, OfAClosedBodyDrawnFromInsideTooLeaveItClosed) {
  const auto torus = [](double u, double v) {
    const double a = 2 * kPi * std::fmod(u, 1), b = 2 * kPi * std::fmod(v, 1), r = 2 + std::cos(b);
    return Vec3(r * std::cos(a), r * std::sin(a), std::sin(b));
  };
  const TriangleMesh single = quads_from_both_sides(16, torus, false), mesh = quads_from_both_sides(16, torus);
  ASSERT_EQ(diagnose(single).open_surfaces, 0u);
  EXPECT_EQ(repair(mesh).triangles, single.triangles);
  EXPECT_EQ(diagnose(repair(mesh)).open_surfaces, 0u);
  // Shells of different vertices: each is closed alone.
  const TriangleMesh outer = box({0, 0, 0}, {3, 2, 1});
  for (const TriangleMesh& shells :
       {both(outer, cut_in_four(turned_over(outer))), both(cut_in_four(turned_over(outer)), outer)}) {
    const TriangleMesh one = repair(shells);
    EXPECT_NEAR(surface_area(one), surface_area(outer), 1e-12);
    EXPECT_NEAR(enclosed_volume(one), 6, 1e-12);
  }
}

// Otherwise memory and time grow with the square of the triangles.
TEST(CoincidingFaces, OfAHeapOfTrianglesAreNotSearched) {
  TriangleMesh heap;
  for (int i = 0; i < 4000; ++i) {
    const TriangleMesh one = make_plate(1 + 1e-3 * i, 1);
    heap.append(i % 2 == 0 ? one : turned_over(one));
  }
  EXPECT_THAT(diagnostic_messages(diagnose(heap)), Contains(HasSubstr("too many triangles lie in one place")));
}

TEST(CoincidingFaces, OfTwoMaterialsStayAndAreNamedWhereTheirSurfacesAreOpen) {
  TriangleMesh mesh = read_mesh(kMeshes + "trihedral_two_sided.obj");
  mesh.materials.push_back({"canvas"});
  for (std::size_t t = 6; t < 12; ++t) mesh.triangle_material[t] = 1;
  EXPECT_EQ(repair(mesh).triangles.size(), 12u);
  EXPECT_THAT(diagnostic_messages(diagnose(mesh)), testing::Not(Contains(HasSubstr("another material"))));
  // A back of its own vertices is an open surface.
  TriangleMesh back = cut_in_four(turned_over(make_plate(1, 1)));
  back.materials = {{"canvas"}};
  const TriangleMesh plate = both(make_plate(1, 1), back);
  EXPECT_EQ(repair(plate).triangles.size(), 10u);
  EXPECT_THAT(
      diagnostic_messages(diagnose(plate)),
      Contains(HasSubstr("10 triangles coincide with others of another material with opposite orientation, in open "
                         "surfaces (1 m^2)")));
}

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

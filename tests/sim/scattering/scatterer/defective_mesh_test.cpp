// SPDX-License-Identifier: BSD-3-Clause
// Defective meshes as CAD programs export them: defects are reported and, where possible, repaired.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr double kRounding = 1e-9;  // relative; the same facets in another order
const double k10 = wavenumber(10e9);

void flip(TriangleMesh& mesh, std::size_t triangle) {
  std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
}

void add(TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  mesh.triangles.push_back(triangle);
  mesh.triangle_part.push_back(0);
  mesh.triangle_material.push_back(0);
}

// The largest difference of the two scattering matrices over a few directions, relative to the largest element.
double difference(const TriangleMesh& a, const TriangleMesh& b) {
  double max = 0, size = 0;
  for (const double azimuth : {3.0, 40.0, 111.0, 200.0}) {
    const auto sa = echo(a, direction(azimuth, 20), k10), sb = echo(b, direction(azimuth, 20), k10);
    for (int i = 0; i < 4; ++i) {
      max = std::max(max, std::abs(sa[i] - sb[i]));
      size = std::max(size, std::abs(sa[i]));
    }
  }
  return max / size;
}

TEST(DefectiveMesh, InsideOutHasTheEchoOfTheValidOneOnceRepaired) {
  const TriangleMesh valid = make_icosahedral_reflector();
  TriangleMesh inverted = valid;
  for (std::size_t t = 0; t < inverted.triangles.size(); ++t) flip(inverted, t);
  EXPECT_GT(difference(valid, inverted), 0.1) << "without repair its inside is visible";
  EXPECT_LT(difference(valid, repair(inverted)), kRounding);
}

TEST(DefectiveMesh, OfMixedNormalsHasTheEchoOfTheValidOne) {
  const TriangleMesh valid = make_icosahedral_reflector();
  TriangleMesh mixed = valid;
  for (std::size_t t = 0; t < mixed.triangles.size(); t += 3) flip(mixed, t);
  // both sides are viewed: hidden parts are removed as polygons, to the smallest patch area
  EXPECT_LT(difference(valid, repair(mixed)), 1e-6);
}

TEST(DefectiveMesh, WithRepeatedAndDegenerateTrianglesHasTheEchoOfTheValidOne) {
  const TriangleMesh valid = make_icosahedral_reflector();
  TriangleMesh dirty = valid;
  for (std::size_t t = 0; t < 60; t += 7) {
    add(dirty, valid.triangles[t]);
    add(dirty, {valid.triangles[t][0], valid.triangles[t][1], valid.triangles[t][1]});
  }
  EXPECT_LT(difference(valid, repair(dirty)), kRounding);
}

TEST(DefectiveMesh, OfTwoSidedSheetsHasTheEchoOfTheSheets) {
  const TriangleMesh sheet = make_triangular_trihedral(0.3);
  TriangleMesh two_sided = sheet;
  for (const auto& t : sheet.triangles) add(two_sided, {t[0], t[2], t[1]});
  EXPECT_LT(difference(sheet, repair(two_sided)), kRounding);
}

// Front and back of a trihedral are separate parts, of conductor and of an impedance: the part on the viewed side
// scatters, whatever the order of the parts.
TEST(DefectiveMesh, SheetsOfTwoMaterialsScatterByTheViewedSide) {
  MaterialSpec dull;
  dull.name = "dull";
  dull.kind = SurfaceKind::kImpedance;
  dull.resistance = 0.5;
  const TriangleMesh sheet = make_triangular_trihedral(0.3);
  const auto side = [&](const std::string& name, bool back) {
    TriangleMesh mesh = sheet;
    mesh.part_names = {name};
    mesh.triangle_part.assign(mesh.triangles.size(), 0);
    for (std::size_t t = 0; back && t < mesh.triangles.size(); ++t) flip(mesh, t);
    return mesh;
  };
  const auto echo_at = [&](TriangleMesh mesh, const Vec3& r_hat, const std::vector<PartMaterial>& parts) {
    const auto materials = assign_materials(mesh, {}, parts);
    return echo(Scatterer(repair(mesh), materials, radians(20)), radar_basis(r_hat), k10);
  };
  for (const char* first : {"front", "back"}) {
    const bool back_first = first == std::string("back");
    TriangleMesh both = side(first, back_first);
    both.append(side(back_first ? "front" : "back", !back_first));
    both = welded(both);
    const Vec3 into = direction(40, 30), behind = direction(220, -30);
    const auto front = echo_at(both, into, {{"back", dull}}), front_alone = echo_at(side("front", false), into, {});
    const auto back = echo_at(both, behind, {{"back", dull}}),
               back_alone = echo_at(side("back", true), behind, {{"back", dull}});
    for (int i = 0; i < 4; ++i) {
      EXPECT_LT(std::abs(front[i] - front_alone[i]), 1e-6 * largest(front_alone)) << first << " comes first";
      EXPECT_LT(std::abs(back[i] - back_alone[i]), 1e-6 * largest(back_alone)) << first << " comes first";
    }
  }
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/prepare_target.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/ship/make_ship.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using namespace testing_echoes;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class PreparedCylinder : public testing::Test {
 protected:
  PreparedCylinder() {
    source_.mesh = folder_.path() / "cylinder.stl";
    source_.lowest_hz = source_.highest_hz = 10e9;
    TriangleMesh mesh = make_cylinder(0.5, 2, 16);
    mesh.triangles.push_back(mesh.triangles.front());
    mesh.triangle_part.push_back(mesh.triangle_part.front());
    mesh.triangle_material.push_back(mesh.triangle_material.front());
    write_mesh(source_.mesh, mesh);
  }

  const TemporaryFolder folder_;
  TargetSource source_;
};

TEST_F(PreparedCylinder, IsRepairedWithAWarning) {
  const PreparedTarget target = prepare_target(load_target_mesh(source_), {});
  EXPECT_EQ(target.mesh.triangles.size(), make_cylinder(0.5, 2, 16).triangles.size());
  EXPECT_FALSE(target.warnings.empty());
  ASSERT_EQ(target.materials.size(), 1u);
  EXPECT_EQ(target.materials.front().kind, SurfaceKind::kPec);
  EXPECT_NEAR(target.scatterer->radius(), std::hypot(0.5, 1.0), 1e-6);
}

TEST_F(PreparedCylinder, HasMaterialsAndAWaterline) {
  source_.materials = {{std::nullopt, SEAGLINT_SOURCE_DIR "/assets/materials/stainless_steel.yaml", ""}};
  ScattererSettings settings;
  settings.waterline_m = 0.25;
  settings.sea_reflects = true;
  const PreparedTarget target = prepare_target(load_target_mesh(source_), settings);
  ASSERT_EQ(target.materials.size(), 2u);
  EXPECT_NE(target.materials[0].kind, SurfaceKind::kPec);
  EXPECT_EQ(target.materials[1].kind, SurfaceKind::kSubmerged);
  for (std::size_t t = 0; t < target.mesh.triangles.size(); ++t) {
    double top = -1e9;
    for (const std::uint32_t v : target.mesh.triangles[t]) top = std::max(top, target.mesh.vertices[v].z());
    EXPECT_EQ(target.mesh.triangle_material[t] == 1, top <= 0.25 + 1e-9);
  }
}

TEST_F(PreparedCylinder, EndsAtTheWaterlineWithoutSeaReflection) {
  ScattererSettings settings;
  settings.waterline_m = 0.25;
  const PreparedTarget target = prepare_target(load_target_mesh(source_), settings);
  ASSERT_EQ(target.materials.size(), 1u);
  EXPECT_NEAR(bounds(target.mesh).lower.z(), 0.25, 1e-9);
}

// Sizes of the bodies in a file, and the detail that follows from them.

TriangleMesh at(const TriangleMesh& mesh, const Vec3& place) { return transformed(mesh, Mat3::Identity(), place); }

// A horizontal sheet of `cells` squares along either side.
TriangleMesh sea(double side, std::uint32_t cells) {
  return transformed(cut_plate(side, side, cells), axis_rotation(-kPi / 2, Vec3::UnitY()), Vec3::Zero());
}

// A hull, a cylinder of 6 m, and a mast of 1 m that intersects it.
TriangleMesh hull_and_mast() {
  TriangleMesh mesh = make_cylinder(1, 6, 24);
  mesh.append(at(make_cylinder(0.1, 1, 12), {0, 0, 3.2}));
  return mesh;
}

double size_of(const Scatterer& target, std::size_t facet) { return target.bodies().at(static_cast<int>(facet)); }

const double kHull = std::hypot(1, 3);

TEST(BodySize, OfAFittingIsThatOfTheSurfaceItReaches) {
  const Scatterer target(hull_and_mast());
  for (std::size_t f = 0; f < target.facets().size(); ++f) EXPECT_NEAR(size_of(target, f), kHull, 1e-12);
  // The mast is a metre tall: it may stand on the hull or hang above it by as much as its half-length.
  for (const auto& [height, fitting] : {std::pair{3.5, true}, {3.9, true}, {4.2, false}}) {
    TriangleMesh mesh = make_cylinder(1, 6, 24);
    const std::size_t own = mesh.triangles.size();
    mesh.append(at(make_cylinder(0.1, 1, 12), {0.3, 0, height}));
    EXPECT_NEAR(size_of(Scatterer(mesh), own), fitting ? kHull : std::hypot(0.1, 0.5), 1e-12) << height;
  }
}

TEST(BodySize, DoesNotDependOnOtherBodies) {
  const Scatterer alone(hull_and_mast());
  const std::size_t own = alone.facets().size();
  TriangleMesh with_sea = hull_and_mast(), with_decoy = hull_and_mast(), with_another = hull_and_mast();
  with_sea.append(sea(40, 11));
  with_decoy.append(at(make_sphere(0.3, 2), {5, 0, 0}));
  with_another.append(at(hull_and_mast(), {2.5, 0.3, 0}));
  for (const TriangleMesh& mesh : {with_sea, with_decoy, with_another}) {
    const Scatterer target(mesh);
    for (std::size_t f = 0; f < own; ++f) EXPECT_NEAR(size_of(target, f), size_of(alone, f), 1e-12);
    const SmallestAreas areas(target, {}), before(alone, {});
    EXPECT_NEAR(areas.on(0), before.on(0), 1e-12 * before.on(0));
  }
  EXPECT_NEAR(size_of(Scatterer(with_sea), own), 20 * std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(size_of(Scatterer(with_decoy), own), 0.3, 1e-12);
  // A sheet smaller than the surface it reaches is a fitting.
  TriangleMesh with_net = hull_and_mast();
  with_net.append(at(sea(1, 4), {1.2, 0, 0}));
  EXPECT_NEAR(size_of(Scatterer(with_net), own), kHull, 1e-12);
}

TEST(BodySize, TurnsAndMovesWithTheTarget) {
  TriangleMesh mesh = hull_and_mast();
  mesh.append(sea(40, 11));
  mesh.append(at(make_sphere(0.3, 2), {5, 0, 5}));
  const Scatterer target(mesh);
  const Mat3 R = axis_rotation(0.7, Vec3(1, 2, -1).normalized());
  const Scatterer turned(transformed(mesh, R, {800, -100, 30}));
  EXPECT_EQ(turned.bodies().surface_of, target.bodies().surface_of);
  for (std::size_t i = 0; i < target.bodies().radius.size(); ++i)
    EXPECT_NEAR(turned.bodies().radius[i], target.bodies().radius[i], 1e-11);
}

// 57 closed parts that overlap slightly: all have the hull's size.
TEST(BodySize, OfTheShipIsThatOfItsHull) {
  const Scatterer ship(make_combatant());
  EXPECT_NEAR(min_patch(ship), 5e-3, 1e-4);
  EXPECT_EQ(std::ranges::min(ship.bodies().radius), std::ranges::max(ship.bodies().radius));
}

// Targets outside or at the limits of the solver's validity.

// A bar of 1 m with sides of 9 mm: a wavelength is 10 mm at 30 GHz, 30 mm at 10 GHz.
TEST(TargetCheck, WarnsOfBarsThinnerThanAThirdOfAWavelength) {
  MeshBuilder builder;
  builder.begin_part("bar");
  add_box(builder, {}, {0.009, 1, 0.009});
  const TriangleMesh mesh = builder.take();
  const Scatterer bar(mesh);
  EXPECT_THAT(check_edges(bar, true, 10e9, 10e9, mesh.part_names),
              ElementsAre(HasSubstr("their echo; most of it: part 'bar'")));
  EXPECT_THAT(check_edges(bar, true, 30e9, 30e9), ElementsAre());
  EXPECT_THAT(check_edges(bar, true, 10e9, 10e9),
              ElementsAre(HasSubstr("4 m of 4.07 m of diffracting edges belong to bars or strips narrower than a third "
                                    "of a wavelength at 10 GHz")));
  EXPECT_THAT(check_edges(Scatterer(make_plate(1, 0.009)), true, 10e9, 10e9), ElementsAre(HasSubstr("2 m of 2.02 m")));
  EXPECT_THAT(check_edges(Scatterer(make_icosahedral_reflector()), true, 1e9, 1e9), ElementsAre());
}

// A wavelength is 30 mm at 10 GHz. Edges of a bar are the subject of check_edges().
TEST(TargetCheck, WarnsOfRoundBarsThinnerThanTheWavelength) {
  TriangleMesh mesh = make_cylinder(0.5, 1, 32);
  mesh.part_names = {"tank", "rail"};
  TriangleMesh rail = transformed(make_cylinder(0.01, 2, 32), Mat3::Identity(), Vec3(1, 0, 0));
  rail.part_names = {"rail"};
  mesh.append(rail);
  mesh.part_names = {"tank", "rail"};
  for (std::size_t t = mesh.triangles.size() - rail.triangles.size(); t < mesh.triangles.size(); ++t)
    mesh.triangle_part[t] = 1;
  EXPECT_THAT(check_bars(Scatterer(mesh), 10e9, mesh.part_names),
              ElementsAre(AllOf(HasSubstr("2 m of round bars are thinner than 0.7 wavelengths at 10 GHz"),
                                HasSubstr("most of it: part 'rail'"))));
  EXPECT_THAT(check_bars(Scatterer(mesh), 12e9, mesh.part_names), ElementsAre());
  EXPECT_THAT(check_bars(Scatterer(make_plate(1, 0.009)), 10e9), ElementsAre());
}

// A box of which the wave sees the outside has convex edges; from inside they are concave, and right angles are images.
TEST(TargetCheck, WarnsOfEdgesOfMaterialsThatDoNotDiffract) {
  MaterialSpec lossy;
  lossy.kind = SurfaceKind::kImpedance;
  const auto found = [&](const TriangleMesh& mesh) {
    return check_edges(Scatterer(mesh, {lossy}, 0.3), true, 10e9, 10e9);
  };
  EXPECT_THAT(found(make_dihedral(1, 1, radians(90))), ElementsAre());
  EXPECT_THAT(found(make_dihedral(1, 1, radians(80))), ElementsAre(HasSubstr("1 m of 7 m of edges do not diffract")));
  EXPECT_THAT(check_edges(Scatterer(make_dihedral(1, 1, radians(80)), {}, 0.3), true, 10e9, 10e9), ElementsAre());
}

TEST(TargetCheck, WarnsOfSheetsThickerThanATenthOfAWavelength) {
  const auto found = [](const TriangleMesh& mesh, double thickness_m, bool followed = true) {
    return check_edges(Scatterer(mesh, {}, 0.3, thickness_m), followed, 8e9, 16e9);
  };
  EXPECT_THAT(found(make_plate(1, 1), 1.8e-3), ElementsAre());
  EXPECT_THAT(found(make_plate(1, 1), 2e-3),
              ElementsAre(HasSubstr("sheets of 2 mm are 0.11 wavelengths thick at 16 GHz")));
  EXPECT_THAT(found(make_icosahedral_reflector(), 1e-3),
              ElementsAre(HasSubstr("1 mm has no effect: no surface is open")));
  MaterialSpec lossy;
  lossy.kind = SurfaceKind::kImpedance;
  EXPECT_THAT(check_edges(Scatterer(make_plate(1, 1), {lossy}, 0.3, 1e-3), true, 8e9, 16e9),
              ElementsAre(HasSubstr("1 mm has no effect")));
  EXPECT_THAT(found(make_plate(1, 1), 1e-3, false), ElementsAre(HasSubstr("1 mm has no effect: edges are off")));
  EXPECT_THAT(found(make_icosahedral_reflector(), 0), ElementsAre());
}

// Defective meshes as CAD programs export them: defects are reported and, where possible, repaired.

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

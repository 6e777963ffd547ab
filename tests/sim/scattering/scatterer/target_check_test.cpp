// SPDX-License-Identifier: BSD-3-Clause
// Targets outside or at the limits of the solver's validity.
#include "sim/scattering/scatterer/prepare_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// A bar of 1 m with sides of 9 mm: a wavelength is 10 mm at 30 GHz, 30 mm at 10 GHz.
TEST(TargetCheck, WarnsOfBarsThinnerThanAThirdOfAWavelength) {
  TriangleMesh mesh;
  for (const double z : {0.0, 0.009}) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.009, 0.0}, {0.009, 1.0}, {0.0, 1.0}})
      mesh.vertices.push_back({x, y, z});
  }
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                    {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  mesh.part_names = {"bar"};
  mesh.triangle_part.assign(12, 0);
  mesh.triangle_material.assign(12, 0);
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

}  // namespace
}  // namespace seaglint

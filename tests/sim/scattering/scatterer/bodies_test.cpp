// SPDX-License-Identifier: BSD-3-Clause
// Sizes of the bodies in a file, and the detail that follows from them.
#include "sim/core/numbers/rotation.h"
#include "sim/scattering/scatterer/scatterer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/ship/make_ship.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

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
  const Scatterer ship(make_ship());
  EXPECT_NEAR(min_patch(ship), 5e-3, 1e-4);
  EXPECT_EQ(std::ranges::min(ship.bodies().radius), std::ranges::max(ship.bodies().radius));
}

}  // namespace
}  // namespace seaglint

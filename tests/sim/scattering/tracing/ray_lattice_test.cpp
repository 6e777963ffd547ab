// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/ray_paths.h"

#include <gmock/gmock.h>

#include "sim/core/process/error.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;
using testing::HasSubstr;

TEST(RayLattice, HasOneRayInEveryCellAndTheQuarterThatContainsItsRay) {
  const Scatterer plate(make_plate(3, 2));
  const RayLattice lattice(plate, radar_basis(direction(20, 5)), 0.004);
  const double side = 0.004 * (1 << RayLattice::kHalvings);
  for (std::size_t tile = 0; tile < lattice.tiles(); ++tile) {
    const Box square = lattice.window(tile).boxes()[0];
    EXPECT_NEAR((square.upper - square.lower).x(), RayLattice::kTileSide * side, 1e-12);
    for (const std::int64_t i : {0, 5, 63}) {
      const LatticeCell cell = lattice.cell(tile, i, 7);
      const Vec2 corner = square.lower + side * Vec2(static_cast<double>(i), 7), ray = lattice.ray(cell);
      const Vec2 inside = ray - corner;
      EXPECT_TRUE(std::min(inside.x(), inside.y()) >= -1e-12 && inside.maxCoeff() <= side + 1e-12);
      const LatticeCell quarter = lattice.quarter(cell, ray);
      EXPECT_EQ(quarter.level, 1);
      EXPECT_EQ(quarter.column, 2 * cell.column + (ray.x() - corner.x() >= side / 2));
      EXPECT_EQ(quarter.row, 2 * cell.row + (ray.y() - corner.y() >= side / 2));
    }
  }
}

TEST(RayLattice, CoversThePlateAndAimsAtEveryPanelThatFacesTheAntenna) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.append(transformed(make_plate(0.01, 0.01), Mat3::Identity(), {0.5, 0.3, 0.2}));
  const Scatterer target(mesh);
  const RadarBasis basis = radar_basis(direction(10, 0));
  const RayLattice lattice(target, basis, 0.01);
  double area = 0;
  std::size_t aimed = 0;
  for (std::size_t tile = 0; tile < lattice.tiles(); ++tile) {
    area += lattice.window(tile).area();
    aimed += lattice.aimed(tile).size();
    for (const Vec2& ray : lattice.aimed(tile)) {
      const Box square = lattice.window(tile).boxes()[0];
      EXPECT_TRUE(ray.x() >= square.lower.x() && ray.y() >= square.lower.y());
      EXPECT_TRUE(ray.x() < square.upper.x() && ray.y() < square.upper.y());
    }
  }
  EXPECT_GE(area, std::cos(radians(10)));
  EXPECT_GE(aimed, 10u);  // the middle and each of the four sides of both plates
}

TEST(RayLattice, RefusesMoreThanTenThousandMillionRays) {
  const Scatterer plate(make_plate(100, 100));
  EXPECT_NO_THROW(RayLattice(plate, radar_basis(Vec3::UnitX()), 1.01e-3));
  try {
    const RayLattice too_fine(plate, radar_basis(Vec3::UnitX()), 0.9e-3);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("rays 0.0009 m apart over a target of 100 x 100 m are 1.2e+10, more than 1e+10"));
  }
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Levels of facets against the closed form of a plate, and their independence of its triangles.
#include "tools/rcs/view_export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/observation/observation.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using testing_echoes::cut_plate;

constexpr double kWavenumber = 2 * kPi * 10e9 / kSpeedOfLight;

FacetLevels levels_of(const Scatterer& plate, double elevation_deg, std::optional<std::size_t> element) {
  const RadarBasis basis = radar_basis(direction_to_radar(0, radians(elevation_deg)));
  const auto view = points_of(plate, monostatic(basis), kWavenumber, 1e-3, {0, 8, false});
  return facet_levels(plate, view.points, kWavenumber, element);
}

// Physical optics of a plate of area A at normal incidence: sigma = 4 pi A^2 / lambda^2 in hh and vv, nothing in hv.
TEST(FacetLevels, OfAPlateAreThoseOfItsClosedFormHoweverItIsCut) {
  const double wavelength = 2 * kPi / kWavenumber, sigma_m2 = 4 * kPi * std::pow(0.3 * 0.2 / wavelength, 2);
  for (const std::uint32_t cells : {1, 5}) {
    const Scatterer plate(cut_plate(0.3, 0.2, cells));
    const FacetLevels both = levels_of(plate, 0, std::nullopt);
    ASSERT_EQ(both.dbsm.size(), plate.facets().size());
    for (const double level : both.dbsm) EXPECT_NEAR(level, 10 * std::log10(sigma_m2), 1e-6) << cells;
    EXPECT_NEAR(both.highest_dbsm, 10 * std::log10(sigma_m2), 1e-6);
    EXPECT_NEAR(levels_of(plate, 0, 3).highest_dbsm, 10 * std::log10(sigma_m2), 1e-6);
    EXPECT_LT(levels_of(plate, 0, 1).highest_dbsm, -200);
    // Off the normal too: the sum over the plane, sinc over its height.
    const double u = kWavenumber * 0.2 * std::sin(radians(20.0));
    EXPECT_NEAR(levels_of(plate, 20, 3).highest_dbsm,
                10 * std::log10(sigma_m2 * std::pow(std::cos(radians(20.0)) * std::sin(u) / u, 2)), 1e-6)
        << cells;
  }
}

TEST(FacetLevels, BelongToTheMeshOfFacets) {
  const Scatterer plate(cut_plate(0.3, 0.2, 3));
  const TriangleMesh mesh = mesh_of_facets(plate);
  ASSERT_EQ(mesh.triangles.size(), plate.facets().size());
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm() / 2;
  EXPECT_NEAR(area, 0.3 * 0.2, 1e-12);
}

}  // namespace
}  // namespace seaglint

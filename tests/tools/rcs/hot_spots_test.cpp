// SPDX-License-Identifier: BSD-3-Clause
// Hot spots of a target: levels of its facets, the centres that are shown, and what a page has of both.
#include "tools/rcs/hot_spots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/observation/observation.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing_echoes::cut_plate;

constexpr double kWavenumber = 2 * kPi * 10e9 / kSpeedOfLight;

FacetLevels levels_of(const Scatterer& plate, double elevation_deg, ShownElement element) {
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

// The reflector seen between two of its cells.
class HotSpotsOfAReflector : public testing::Test {
 protected:
  HotSpotsOfAReflector() {
    const RadarBasis radar = radar_basis(direction_to_radar(radians(30.0), radians(3.0)));
    points_ = points_of(scatterer_, monostatic(radar), kWavenumber, 1e-3, {}).points;
    centres_ = cluster_centres(points_, kWavenumber, 0.1);
  }
  HotSpotView view(const HotSpotSettings& settings) const {
    return hot_spot_view(scatterer_, points_, kWavenumber, centres_, settings);
  }
  static double level(const ScatteringCentre3d& centre) { return dbsm_of_area(centre.peak_rcs()); }

  const Scatterer scatterer_{make_icosahedral_reflector()};
  std::vector<Point> points_;
  std::vector<ScatteringCentre3d> centres_;
};

TEST_F(HotSpotsOfAReflector, ShowCentresDownToThirtyDecibelsBelowTheStrongest) {
  const HotSpotView all = view({});
  ASSERT_GE(all.centres.size(), 5u);
  ASSERT_LT(all.centres.size(), centres_.size());
  for (std::size_t i = 0; i < all.centres.size(); ++i) EXPECT_EQ(level(all.centres[i]), level(centres_[i]));
  EXPECT_GE(level(all.centres.back()), level(centres_[0]) - kBallRange_db);
  EXPECT_LT(level(centres_[all.centres.size()]), level(centres_[0]) - kBallRange_db);
  EXPECT_EQ(view({.most_centres = 3}).centres.size(), 3u);
  // Those that are strong in the other elements alone are added.
  EXPECT_GT(view({.elements = {std::nullopt, 1}}).centres.size(), all.centres.size());
}

TEST_F(HotSpotsOfAReflector, HaveTheLevelOfTheWholeEcho) {
  const HotSpotView shown = view({.elements = {std::nullopt, 0, 1, 2, 3}});
  const ScatteringMatrix sum = direct_sum(points_, kWavenumber);
  double most = -1000;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(shown.total_dbsm[i + 1], dbsm(sum[i]), 1e-6);
    most = std::max(most, dbsm(sum[i]));
  }
  EXPECT_NEAR(shown.total_dbsm[0], most, 1e-6);
}

// A trihedron of the reflector has its centre at its apex, wherever the cells of the centres begin.
TEST_F(HotSpotsOfAReflector, HaveOneCentreAtAnApex) {
  const auto at_apex = [&](const ScatteringCentre3d& centre) {
    return centre.bounces == 3 && centre.mechanism == Mechanism::kPhysicalOptics && centre.part == 0;
  };
  ASSERT_EQ(std::ranges::count_if(centres_, at_apex), 1);
  const Vec3 apex = std::ranges::find_if(centres_, at_apex)->position();
  EXPECT_NEAR(apex.x(), 0.182792, 1e-6);
  EXPECT_LT(std::hypot(apex.y(), apex.z()), 1e-6);
}

TEST_F(HotSpotsOfAReflector, AreWrittenWithTheSectionOfTheWaterline) {
  HotSpotView shown = view({.range_db = 300});
  shown.azimuth_deg = 30;
  const HotSpotTarget target{"reflector <1>", scatterer_, std::vector<std::string>(20, "cell"), {shown}};
  const auto json = nlohmann::json::parse(hot_spots_json(std::span(&target, 1), {.range_db = 300}));
  EXPECT_EQ(json.at("step_db"), 2) << "levels are bytes";
  EXPECT_EQ(json.at("elements"), nlohmann::json({"largest of hh, hv, vh, vv"}));
  const auto& of = json.at("targets")[0];
  EXPECT_EQ(of.at("name"), "reflector <1>");
  EXPECT_NE(of.at("waterline"), "");
  EXPECT_NE(of.at("triangle_parts"), "");
  const auto& first = of.at("views")[0].at("centres")[0];
  EXPECT_NEAR(first[0].get<double>(), centres_[0].position().x(), 6e-4);
  EXPECT_EQ(first[3], centres_[0].part);
  EXPECT_EQ(first[4], centres_[0].bounces);
  EXPECT_NEAR(first[6].get<double>(), level(centres_[0]), 0.051);
}

}  // namespace
}  // namespace seaglint

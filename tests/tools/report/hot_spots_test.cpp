// SPDX-License-Identifier: BSD-3-Clause
// The targets of a report's page, coloured by their hot spots.
#include "tools/report/explorer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/scenario/reader.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::Not;

class HotSpotsOf : public testing::Test {
 protected:
  static Scenario scenario(const std::string& azimuths, const std::string& mesh = "assets/icosahedral_reflector.glb") {
    return parse_scenario(fmt::format("seaglint: 1\nview: {{azimuth_deg: {}, elevation_deg: 2}}\n"
                                      "targets: {{line: {{label: 1, points: [{{position_m: [0, 0, 0], amplitude_m: "
                                      "1}}]}}, corner: {{label: 0, mesh: {}/{}, motion: {{model: fixed}}}}}}\n"
                                      "dataset: {{maps_per_case: 1, realisations_per_case: 1}}\n",
                                      azimuths, SEAGLINT_SOURCE_DIR, mesh),
                          "hot.yaml");
  }
  static HotSpots of(const Scenario& scenario, int threads = 1) {
    const SamplePlan plan(scenario);
    return hot_spots(scenario, plan, load_targets(scenario, plan), threads, nullptr);
  }
};

TEST_F(HotSpotsOf, MeshesAreShownAtEveryView) {
  const HotSpots spots = of(scenario("[200, 10, 50]"));
  const auto json = nlohmann::json::parse(spots.json);
  ASSERT_EQ(json.at("targets").size(), 1u);  // ideal points have no facets
  const auto& corner = json.at("targets")[0];
  EXPECT_EQ(corner.at("name"), "corner");
  ASSERT_EQ(corner.at("views").size(), 3u);
  EXPECT_EQ(corner.at("views")[0].at("azimuth_deg"), 10);
  EXPECT_EQ(corner.at("views")[2].at("azimuth_deg"), 200);
  EXPECT_THAT(spots.about, HasSubstr(" GHz, vv, "));
  EXPECT_THAT(spots.about, Not(HasSubstr("views")));
}

TEST_F(HotSpotsOf, AreTheSameForAnyNumberOfThreads) {
  const Scenario both = scenario("[10, 50]");
  EXPECT_EQ(of(both, 1).json, of(both, 2).json);
}

TEST_F(HotSpotsOf, ManyViewsAreThinned) {
  const HotSpots spots = of(scenario("0:49:1"));
  EXPECT_EQ(nlohmann::json::parse(spots.json).at("targets")[0].at("views").size(), 17u);  // every third of 50
  EXPECT_THAT(spots.about, HasSubstr("17 of the scenario’s 50 views"));
}

}  // namespace
}  // namespace seaglint

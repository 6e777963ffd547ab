// SPDX-License-Identifier: BSD-3-Clause
// Bodies are loaded once for each size, and what does not depend on the size once for all.
#include "tools/pipeline/body_model.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/layout/layout.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

class BodyModels : public testing::Test {
 protected:
  BodyModels() { write_mesh(folder_.path() / "sphere.stl", make_sphere(1, 1)); }

  // Target t of a sphere of radius 1 m about its origin.
  Scenario scenario_of(const std::string& target, const std::string& more = "") const {
    return parse_scenario(
        fmt::format("seaglint: 1\ntargets:\n  t: {{label: 1, mesh: sphere.stl, {}}}\n{}\n", target, more),
        (folder_.path() / "file.yaml").string());
  }
  std::vector<std::shared_ptr<const BodyModel>> models(const Scenario& scenario, std::size_t target = 0) {
    return loaded_.models(scenario, scenario.targets[target]);
  }
  std::string complaint(const Scenario& scenario) {
    try {
      models(scenario);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  TemporaryFolder folder_;
  LoadedBodies loaded_;
};

TEST_F(BodyModels, HaveTheFactorOfTheTargetTimesThatOfTheBody) {
  const Scenario scenario = scenario_of(
      "scale: 3, layout: {line: {count: 20}, scales: {lowest: 0.5, highest: 2}, heights: "
      "{lowest_m: 10, highest_m: 10}}, motion: {model: float}");
  const std::vector<double> factors = body_scales(scenario.targets[0].layout, 1);
  std::set<const PreparedTarget*> prepared;
  const auto bodies = models(scenario);
  ASSERT_EQ(bodies.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(bodies[i]->scale, 3 * factors[i]);
    EXPECT_NEAR(bodies[i]->radius_m, 3 * factors[i], 1e-6 * factors[i]);  // digits of STL
    EXPECT_NEAR(bodies[i]->prepared->scatterer->radius(), 3 * factors[i], 1e-5 * factors[i]);
    prepared.insert(bodies[i]->prepared.get());
  }
  EXPECT_EQ(prepared.size(), 20u);
}

// Froude: of floats alike, periods grow with the square root of the size.
TEST_F(BodyModels, OfFloatsHavePeriodsThatGrowWithTheRootOfTheirSize) {
  const auto particulars = [&](double scale) {
    return std::get<FloatParticulars>(
        models(scenario_of(fmt::format("scale: {}, motion: {{model: float}}", scale))).front()->motion->model);
  };
  const FloatParticulars small = particulars(1), large = particulars(4);
  EXPECT_NEAR(large.diameter / small.diameter, 4, 1e-12);
  EXPECT_NEAR(small.heave.omega0 / large.heave.omega0, 2, 1e-12);
  EXPECT_NEAR(small.roll.omega0 / large.roll.omega0, 2, 1e-12);
  EXPECT_EQ(small.heave.damping, large.heave.damping);
}

TEST_F(BodyModels, OfOneSizeAreOne) {
  const auto bodies = models(scenario_of("layout: {line: {count: 3}}"));
  EXPECT_EQ(bodies[0], bodies[1]);
  EXPECT_EQ(bodies[0], bodies[2]);
  const auto equal = models(scenario_of("scale: 2, layout: {line: {count: 2}, scales: {lowest: 0.5, highest: 0.5}}"));
  EXPECT_EQ(equal[0], equal[1]);
  EXPECT_EQ(equal[0]->prepared, bodies[0]->prepared);
}

// Two targets of one mesh, and seas whose draws leave the mesh as it is.
TEST_F(BodyModels, ShareWhatTheirFieldsDetermine) {
  const Scenario scenario = scenario_of("motion: {model: float, origin_above_waterline_m: 2}",
                                        "  u: {label: 0, mesh: sphere.stl, layout: {line: {count: 2}, bodies: rigid, "
                                        "scales: {highest: 2}}, motion: {model: float, diameter_m: 1}}\n"
                                        "  v: {label: 0, mesh: sphere.stl, solver: {edges: false}}");
  const auto t = models(scenario), u = models(scenario, 1), v = models(scenario, 2);
  EXPECT_EQ(models(scenario_of("layout: {line: {count: 9}, heights: {lowest_m: 1, highest_m: 1}}, motion: {model: "
                               "fixed}"))
                .front()
                ->prepared,
            t.front()->prepared);
  EXPECT_NE(v.front()->prepared, t.front()->prepared);
  EXPECT_NE(v.front()->motion, t.front()->motion);
  // Reflectors of different sizes on one raft.
  EXPECT_EQ(u[0]->motion, u[1]->motion);
  EXPECT_NE(u[0]->prepared, u[1]->prepared);
}

TEST_F(BodyModels, OfManySizesStayWhileTheyAreUsed) {
  const Scenario many = scenario_of("layout: {line: {count: 60}, scales: {highest: 2}}");
  const auto used = models(many);
  models(scenario_of("layout: {line: {count: 60}, scales: {highest: 2}, seed: 5}"));  // nothing refers to these
  const auto again = models(many);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(again[i]->prepared, used[i]->prepared);
}

TEST_F(BodyModels, ReachTheWaterAsTheirSizeSays) {
  const std::string sea = "sea_reflection: {enabled: true}\nview: {elevation_deg: 1}";
  EXPECT_EQ(complaint(scenario_of("layout: {line: {}, heights: {lowest_m: 1.5, highest_m: 1.5}}", sea)), "none");
  EXPECT_THAT(complaint(scenario_of("scale: 2, layout: {line: {}, heights: {lowest_m: 1.5, highest_m: 1.5}}", sea)),
              HasSubstr("file.yaml:3:73: targets.t.layout.heights: its lowest body reaches 0.5 m below the water"));
  EXPECT_THAT(complaint(scenario_of("layout: {line: {count: 2}, scales: {lowest: 3, highest: 3}, heights: {lowest_m: "
                                    "1.5, highest_m: 1.5}}",
                                    sea)),
              HasSubstr("its lowest body reaches 1.5 m below the water"));
  EXPECT_THAT(complaint(scenario_of("scale: 0.25, motion: {model: float, origin_above_waterline_m: -0.5}", sea)),
              HasSubstr("must be greater than -0.25, else the whole target is under water"));
}

TEST_F(BodyModels, OfManySizesHaveFewTriangles) {
  write_mesh(folder_.path() / "fine.stl", make_sphere(1, 4));
  EXPECT_THAT(complaint(parse_scenario("seaglint: 1\ntargets:\n  t: {label: 1, mesh: fine.stl, layout: {line: {count: "
                                       "1000}, scales: {highest: 2}, heights: {lowest_m: 10, highest_m: 10}}}\n",
                                       (folder_.path() / "file.yaml").string())),
              HasSubstr("file.yaml:3:71: targets.t.layout.scales: 1000 bodies of different sizes with 5120 triangles "
                        "each: must have at most 2000000 triangles in all"));
}

// Of two layouts with the same bounds, one has a body at 0.9 m, less than the radius.
TEST_F(BodyModels, AreCheckedAtTheHeightsOfEveryLayout) {
  const std::string sea = "sea_reflection: {enabled: true}\nview: {elevation_deg: 1}";
  int refused = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const Scenario scenario = scenario_of(
        fmt::format("layout: {{line: {{count: 2}}, heights: {{lowest_m: 0.8, highest_m: 1.6}}, seed: {}}}", seed), sea);
    const bool under = std::ranges::min(body_heights_m(scenario.targets[0].layout)) < 1;
    EXPECT_EQ(complaint(scenario) != "none", under) << seed;
    refused += under;
  }
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, 20);
}

}  // namespace
}  // namespace seaglint

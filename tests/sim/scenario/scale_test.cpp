// SPDX-License-Identifier: BSD-3-Clause
// The factor by which the mesh of a target is enlarged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario/sample_plan.h"
#include "sim/scenario/writer.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::HasSubstr;

std::string complaint(const std::string& target) {
  return complaint_about(kShort + "  t: {label: 1, " + target + "}\n");
}

TEST(ScaleOfATarget, IsOneUnlessItIsGiven) {
  const Scenario scenario = parse(kShort + "  t: {label: 1, mesh: a.glb, scale: 2.5}\n");
  EXPECT_EQ(scenario.targets[0].scale, 1);
  EXPECT_EQ(scenario.targets[1].scale, 2.5);
  EXPECT_EQ(parse(effective_yaml(scenario)).targets[1].scale, 2.5);
}

TEST(ScaleOfATarget, IsPositiveAndOfAMesh) {
  EXPECT_THAT(complaint("mesh: a.glb, scale: 0"),
              HasSubstr("file.yaml:4:37: targets.t.scale: value '0': must be a number within 0.001 and 1000"));
  EXPECT_THAT(complaint("mesh: a.glb, scale: -2"),
              HasSubstr("file.yaml:4:37: targets.t.scale: value '-2': must be a number within 0.001 and 1000"));
  EXPECT_THAT(complaint("mesh: a.glb, scale: [1, 2]"), HasSubstr("file.yaml:4:37: targets.t.scale: a list: must be"));
  EXPECT_THAT(complaint("points: [{position_m: [0, 0, 0]}], scale: 2"),
              HasSubstr("file.yaml:4:59: targets.t.scale: value '2': not allowed here: valid only with a mesh"));
}

// Also where the middle of the distribution is the default.
TEST(ScaleOfATarget, IsDrawnOncePerSeaAndSharedByTwins) {
  const Scenario read = parse(kShort +
                              "  t: {label: 1, mesh: a.glb, scale: uniform(0.5 1.5)}\n"
                              "  u: {label: 1, mesh: a.glb, scale: same(targets.t.scale)}\n"
                              "dataset: {maps_per_case: 4, realisations_per_case: 2}\n");
  const Scenario scenario = parse(effective_yaml(read));
  EXPECT_EQ(effective_yaml(scenario), effective_yaml(read));
  const SamplePlan plan(scenario);
  const auto drawn = [&](int realisation, int interval) {
    const Scenario of = plan.drawn(scenario, {.realisation = realisation, .interval = interval});
    EXPECT_EQ(of.targets[1].scale, of.targets[2].scale);
    return of.targets[1].scale;
  };
  EXPECT_EQ(drawn(0, 0), drawn(0, 1));
  EXPECT_NE(drawn(0, 0), drawn(1, 0));
  EXPECT_THAT(complaint("mesh: a.glb, scale: uniform(0 2)"),
              HasSubstr("file.yaml:4:37: targets.t.scale: value '0': must be a number within 0.001 and 1000; where "
                        "targets.t.scale, drawn by uniform(0, 2), is 0"));
}

// The seed of a layout is written only where it is not 0, the middle of this distribution.
TEST(ScaleOfATarget, OfALayoutIsDrawnWithItsSeed) {
  const Scenario read = parse(kShort +
                              "  t: {label: 1, mesh: a.glb, layout: {line: {count: 2}, scales: {highest: 2}, seed: "
                              "integers(0 1)}}\n");
  EXPECT_THAT(effective_yaml(read), HasSubstr("seed: integers(0, 1)"));
  EXPECT_EQ(effective_yaml(parse(effective_yaml(read))), effective_yaml(read));
}

}  // namespace
}  // namespace seaglint

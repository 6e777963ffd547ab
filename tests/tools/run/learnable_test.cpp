// SPDX-License-Identifier: BSD-3-Clause
// A division that a scenario states is checked before its maps are made, with the place in the file.
#include "tools/run/run.h"

#include <gmock/gmock.h>

#include <string>

#include "tests/refusal.h"

namespace seaglint {
namespace {

using testing::StartsWith;

// Two classes of one point each, in 20 seas with a drawn peak period and a drawn swell.
Scenario scenario_with(const std::string& split, const std::vector<Override>& overrides = {}) {
  return parse_scenario(R"yaml(seaglint: 1
view: {azimuth_deg: [30, 80]}
sea: {significant_wave_height_m: [1, 2], peak_period_s: "uniform(6, 10)", spreading: {kind: "choice(none, cos2s)"}}
targets:
  line: {label: 1, points: [{position_m: [0, 0, 1]}]}
  ring: {label: 0, points: [{position_m: [1, 0, 1]}]}
  wall: {label: 0, points: [{position_m: [2, 0, 1]}]}
dataset: {maps_per_case: 20, realisations_per_case: 10}
learning:
  split:
)yaml" + split,
                        "file.yaml", overrides);
}

std::string refusal(const Scenario& scenario) {
  return refusal_of([&] { check_learnable(scenario, SamplePlan(scenario)); });
}

TEST(LearnableSplit, OfDrawnKeysSweepsAndTargetsIsAccepted) {
  EXPECT_EQ(refusal(scenario_with("    hold_out: {sea.peak_period_s: 8:9}\n")), "accepted");
  EXPECT_EQ(refusal(scenario_with("    hold_out: {sea.spreading.kind: cos2s, sea.peak_period_s: [6:7, 9:10]}\n")),
            "accepted");
  EXPECT_EQ(refusal(scenario_with("    hold_out: {significant_wave_height_m: 2}\n")), "accepted");
  EXPECT_EQ(refusal(scenario_with("    hold_out: {target_name: ring}\n")), "accepted");
  EXPECT_EQ(refusal(scenario_with("    by: sea.peak_period_s\n")), "accepted");
  // A measured column has no values before the maps.
  EXPECT_EQ(refusal(scenario_with("    hold_out: {centres: 5:9}\n")), "accepted");
  EXPECT_EQ(refusal(scenario_with("    hold_out: {}\n")), "accepted");
}

TEST(LearnableSplit, IsRefusedWithItsPlace) {
  EXPECT_EQ(refusal(scenario_with("    by: azimut_deg\n")),
            "file.yaml:11:9: learning.split.by: azimut_deg: no column of a data set: did you mean 'azimuth_deg'?");
  EXPECT_EQ(refusal(scenario_with("    by: sea\n    hold_out:\n      centres: 5\n      sea.peak_period: 8\n")),
            "file.yaml:14:24: learning.split.hold_out.sea.peak_period: sea.peak_period: no column of a data set: did "
            "you mean 'sea.peak_period_s'?");
  EXPECT_THAT(refusal(scenario_with("    hold_out: {sea.peak_period_s: 11:12}\n")),
              StartsWith("file.yaml:11:5: learning.split: hold-out sea.peak_period_s=11:12: no map has this value"));
  EXPECT_HAS(refusal(scenario_with("    hold_out: {sea.peak_period_s: 6:10}\n")),
             "all 240 maps are held out: nothing is left to train on");
  EXPECT_HAS(refusal(scenario_with("    hold_out: {sea.peak_period_s: 9:8}\n")),
             "must be a number or LOW:HIGH with LOW <= HIGH");
  EXPECT_HAS(refusal(scenario_with("    hold_out: {target_name: line}\n")), "leaves no map to train on");
  EXPECT_HAS(refusal(scenario_with("    by: gamma\n")), "split by gamma: leaves no map to ");
  EXPECT_THAT(refusal(scenario_with("    by: sea\n", {{"learning.split.hold_out", "{gamma: 9}"}})),
              StartsWith("file.yaml:11:5: learning.split: hold-out gamma=9: no map has this value; the data have 3.3"));
}

TEST(LearnableTargets, AreOfTwoClasses) {
  EXPECT_HAS(refusal(scenario_with("    by: sea\n", {{"targets.line.label", "0"}})),
             "learning needs a target of label 0 and one of label 1");
}

}  // namespace
}  // namespace seaglint

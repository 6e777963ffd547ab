// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/varied_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario/scenario.h"

namespace seaglint {
namespace {

using testing::ElementsAre;

TEST(VariedKeys, AreTheSweepsThenTheDrawnKeys) {
  const Scenario scenario = parse_scenario(R"yaml(
seaglint: 1
view: {azimuth_deg: 10:170:10, elevation_deg: normal(3 0.5)}
sea: {significant_wave_height_m: [0.1, 2], peak_period_s: [8], gamma: dnv_rule, propagation_deg: uniform(0 360)}
targets:
  a: {label: 1, mesh: a.obj, layout: {line: {count: integers(2 5), spacing_m: 9}}, motion: {model: "choice(fixed, ship)"}}
  b: {label: 0, mesh: a.obj, layout: {line: {count: same(targets.a.layout.line.count), spacing_m: 9}}}
clutter: {scr_db: uniform(10 20)}
)yaml",
                                           "varied.yaml");
  const std::vector<VariedKey> keys = varied_keys(scenario);
  std::vector<std::string> texts;
  for (const VariedKey& key : keys) texts.push_back(key.key_path + " " + key.text());
  EXPECT_THAT(texts, ElementsAre("view.azimuth_deg 10 to 170 in 17 values", "sea.significant_wave_height_m 0.1, 2",
                                 "clutter.scr_db uniform(10, 20), once per map",
                                 "sea.propagation_deg uniform(0, 360), once per sea",
                                 "targets.a.layout.line.count integers(2, 5), once per sea",
                                 "targets.a.motion.model choice(fixed, ship), once per sea",
                                 "targets.b.layout.line.count same(targets.a.layout.line.count), once per sea",
                                 "view.elevation_deg normal(3, 0.5), once per observation"));
  EXPECT_THAT(keys[0].trial_values(), ElementsAre("90", "10", "170"));
  EXPECT_THAT(keys[1].trial_values(), ElementsAre("2", "0.1"));
  EXPECT_THAT(keys[4].trial_values(), ElementsAre("3", "2", "5"));
  EXPECT_THAT(keys[5].trial_values(), ElementsAre("fixed", "ship"));
  EXPECT_THAT(keys[7].trial_values(), ElementsAre("3", "-1.5", "7.5"));
}

TEST(VariedKeys, AreNoneOfAScenarioWithOneValueOfEachKey) {
  EXPECT_TRUE(varied_keys(parse_scenario("seaglint: 1\ntargets: {a: {label: 1, mesh: a.obj}}\n", "one.yaml")).empty());
}

}  // namespace
}  // namespace seaglint

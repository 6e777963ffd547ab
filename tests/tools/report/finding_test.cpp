// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/finding.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/tools/study_with_scores.h"

namespace seaglint {
namespace {

ProbeResult probe(const char* name, ProbeKind kind, double accuracy) {
  return {name, kind, "", {evaluation_of({0.5}), evaluation_of({accuracy})}};
}

Scenario ship_and_array() {
  Scenario scenario;
  scenario.targets.resize(2);
  scenario.targets[0].name = "ship";
  scenario.targets[0].label = 1;
  scenario.targets[1].name = "array";
  return scenario;
}

// The fused features have 90 %, each with an interval of 2 points on either side; half of the maps are ships.
std::string finding_with(const std::vector<ProbeResult>& probes, NoiseLevel noise = NoiseLevel::kCnr) {
  Study study = study_of({0.8}, {0.8}, {0.9}, {0.8});
  study.probes = probes;
  Scenario scenario = ship_and_array();
  scenario.clutter.noise_level = noise;
  return finding(study, scenario);
}

constexpr const char* kFused =
    "On unseen seas the fused features tell ship and array apart in 90.0 % (88–92) of the maps; guessing reaches 50.0 "
    "%. ";

TEST(Finding, NamesTheQuantityThatDoesAsWellByItself) {
  const ProbeResult centres = probe("number of centres", ProbeKind::kShape, 0.87);
  const ProbeResult range = probe("sigma_r alone", ProbeKind::kFeature, 0.97);
  EXPECT_EQ(finding_with({centres}),
            std::string(kFused) + "Geometry alone does as well: number of centres reaches 87.0 % (85–89).");
  EXPECT_EQ(finding_with({centres, range}),
            std::string(kFused) + "Geometry alone does as well: sigma_r reaches 97.0 % (95–99).");
}

TEST(Finding, NamesTheBestQuantityWhereNoneDoesAsWell) {
  const ProbeResult centres = probe("number of centres", ProbeKind::kShape, 0.7);
  const ProbeResult velocity = probe("sigma_v alone", ProbeKind::kFeature, 0.8);
  EXPECT_EQ(finding_with({centres, velocity}),
            std::string(kFused) + "No single quantity does as well; the best is sigma_v (motion) with 80.0 % (78–82).");
  EXPECT_EQ(finding_with({probe("MWR alone", ProbeKind::kFeature, 0.5)}),
            std::string(kFused) + "No single quantity tells them by itself.");
}

TEST(Finding, CountsLevelOnlyWhereFeaturesSeeIt) {
  const ProbeResult power = probe("total power", ProbeKind::kScale, 1);
  EXPECT_EQ(finding_with({power}), std::string(kFused) + "No single quantity tells them by itself.");
  EXPECT_EQ(finding_with({power}, NoiseLevel::kThermal),
            std::string(kFused) + "Level alone does as well: total power reaches 100.0 % (98–102).");
}

TEST(Finding, NamesALeakFirst) {
  EXPECT_EQ(
      finding_with({probe("sigma_r alone", ProbeKind::kFeature, 0.97), probe("hop code", ProbeKind::kBlind, 0.6)}),
      std::string(kFused) +
          "Hop code, which does not depend on the target, is away from chance with 60.0 % (58–62): "
          "look for a leak before any other figure is believed.");
}

TEST(Finding, SaysWhenTheClassesAreNotTold) {
  Study study = study_of({0.5}, {0.5}, {0.51}, {0.5});
  study.probes.clear();
  EXPECT_EQ(finding(study, ship_and_array()),
            "On unseen seas the fused features do not tell ship and array apart: 51.0 % (49–53) of the maps, guessing "
            "50.0 %.");
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Values of --set that replace those of the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using ::testing::ElementsAre;

TEST(Overrides, ReplaceAndAddValuesOfTheFile) {
  const Scenario scenario = parse(kPaper, {{"radar.pulses", "64"},
                                           {"view.azimuth_deg", "0:20:10"},
                                           {"sea.significant_wave_height_m", "[1, 2]"},
                                           {"clutter.enabled", "false"},
                                           {"features.max_centres", "10"},
                                           {"targets.array.layout.line.count", "2"},
                                           {"map", "{range_span_m: 100}"},
                                           {"radar.pulses", "32"}});
  EXPECT_EQ(scenario.radar.pulses, 32);
  EXPECT_THAT(scenario.view.azimuth_deg, ElementsAre(0, 10, 20));
  EXPECT_THAT(scenario.sea.significant_wave_height_m, ElementsAre(1, 2));
  EXPECT_FALSE(scenario.clutter.enabled);
  EXPECT_EQ(scenario.features.max_centres, 10);
  EXPECT_EQ(scenario.targets[1].layout->line->count, 2);
  EXPECT_EQ(scenario.map.range_span_m, 100);
}

TEST(Overrides, ApplyInsideLists) {
  const std::string yaml =
      "seaglint: 1\ntargets:\n  p: {label: 0, points: [{position_m: [0, 0, 0]}, {position_m: [1, 1, 1]}]}\n";
  const Scenario scenario =
      parse(yaml, {{"targets.p.points.1.amplitude_m", "3"}, {"targets.p.points.0.position_m.2", "7"}});
  EXPECT_EQ(scenario.targets[0].points[1].amplitude_m, 3);
  EXPECT_EQ(scenario.targets[0].points[0].position_m[2], 7);
  EXPECT_EQ(complaint_about(yaml, {{"targets.p.points.2.amplitude_m", "3"}}),
            "--set targets.p.points.2.amplitude_m: '2' must be the number of an item, from 0 to 1");
}

TEST(Overrides, AreCheckedLikeTheFile) {
  const auto complaint = [](const std::string& path, const std::string& value) {
    return complaint_about(kPaper, {{path, value}});
  };
  EXPECT_EQ(complaint("radar.pulses", "0"), "--set radar.pulses: value '0': must be a whole number within 1 and 65536");
  EXPECT_EQ(complaint("radar.pulse", "5"), "--set radar.pulse: unknown key: did you mean 'pulses'?");
  EXPECT_EQ(complaint("rader.pulses", "5"), "--set rader.pulses: rader: unknown key: did you mean 'radar'?");
  EXPECT_EQ(complaint("radar", "{pulses: x}"),
            "--set radar: radar.pulses: value 'x': must be a whole number within 1 and 65536");
  EXPECT_EQ(complaint("radar", "{pulses: 1, pulses: 2}"),
            "--set radar: radar.pulses: this key appears twice, first in line 1");
  EXPECT_EQ(complaint("radar.pulses.x", "5"), "--set radar.pulses.x: there is nothing below the value '256'");
  EXPECT_EQ(complaint("radar.pulses", ""), "--set radar.pulses: no value: must be a whole number within 1 and 65536");
  EXPECT_EQ(complaint("radar.pulses", "[1"), "--set radar.pulses: value '[1': not valid YAML");
  EXPECT_EQ(complaint("radar.pulse_width_us", "300"),
            "--set radar.pulse_width_us: value '300': must be shorter than radar.pri_us, 250");
  EXPECT_EQ(complaint("", "5"), "--set : must be key.path=value");
  EXPECT_EQ(complaint("radar..pulses", "5"), "--set radar..pulses: must be key.path=value");
  EXPECT_EQ(complaint("targets.boat.label", "1"), "--set targets.boat.label: targets.boat: must have a mesh or points");
}

}  // namespace
}  // namespace seaglint

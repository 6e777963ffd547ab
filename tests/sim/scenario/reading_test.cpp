// SPDX-License-Identifier: BSD-3-Clause
// The contents of a scenario file are read into the structs, and every error is reported with its place.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

#include "sim/core/process/error.h"
#include "sim/scenario/files/document.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using ::testing::ElementsAre;
using ::testing::StartsWith;

TEST(ScenarioReading, TheExampleOfTheDescriptionIsRead) {
  const Scenario scenario = parse(kPaper);
  EXPECT_EQ(scenario.name, "paper");
  EXPECT_EQ(scenario.seed, 42u);
  EXPECT_EQ(scenario.radar.carrier_ghz, 16);
  EXPECT_EQ(scenario.radar.hop_code, HopCode::kRandom);
  EXPECT_EQ(scenario.radar.polarisation, Polarisation::kVv);
  EXPECT_EQ(scenario.view.azimuth_deg.size(), 17u);
  EXPECT_THAT(scenario.view.elevation_deg, ElementsAre(2));
  EXPECT_THAT(scenario.sea.significant_wave_height_m, ElementsAre(0.1, 1, 2));
  ASSERT_EQ(scenario.targets.size(), 2u);
  EXPECT_EQ(scenario.targets[0].name, "ship");
  EXPECT_EQ(scenario.targets[0].label, 1);
  EXPECT_EQ(scenario.targets[0].mesh, "assets/combatant_144m.glb");
  EXPECT_EQ(scenario.targets[0].motion.model, MotionModel::kShip);
  EXPECT_FALSE(scenario.targets[0].layout.has_value());
  EXPECT_EQ(scenario.targets[1].name, "array");
  ASSERT_TRUE(scenario.targets[1].layout.has_value());
  EXPECT_EQ(scenario.targets[1].layout->line->count, 4);
  EXPECT_EQ(scenario.targets[1].layout->line->spacing_m, 40);
  EXPECT_EQ(scenario.dataset.train_fraction, 0.7);
  EXPECT_EQ(scenario.folder, "folder");
}

TEST(ScenarioReading, WhatIsNotGivenKeepsItsDefault) {
  const Scenario scenario = parse(kShort);
  EXPECT_EQ(scenario.name, "file");
  EXPECT_EQ(scenario.seed, 42u);
  EXPECT_EQ(scenario.radar.pulses, 256);
  EXPECT_EQ(scenario.targets[0].unit, "m");
  EXPECT_EQ(scenario.targets[0].motion.model, MotionModel::kFixed);
}

// `targets: {}` is one target without an echo, of a class of its own, which the effective file has again as {}.
TEST(ScenarioReading, NoTargetsAreTheSeaAlone) {
  const std::string sea = "seaglint: 1\ntargets: {}\nclutter: {level: tsc}\n";
  const Scenario scenario = parse(sea);
  EXPECT_TRUE(is_sea_alone(scenario));
  EXPECT_EQ(scenario.targets.front().name, "sea");
  EXPECT_EQ(scenario.targets.front().label, 0);
  EXPECT_THAT(scenario.dataset.classes, ElementsAre("sea"));
  EXPECT_HAS(effective_yaml(scenario), "\ntargets: {}\n");
  EXPECT_TRUE(parse(effective_yaml(scenario)) == scenario);
  EXPECT_HAS(commented_yaml(scenario, ""), "\ntargets: {}\n");
  EXPECT_TRUE(parse(sea + "dataset: {classes: [a, b, c]}\n") == scenario);
  EXPECT_TRUE(is_sea_alone(parse(kShort + "clutter: {level: git}\n", {{"targets", "{}"}})));
  EXPECT_FALSE(is_sea_alone(parse(kShort)));
  EXPECT_TRUE(is_sea_alone(parse(sea + "view: {azimuth_deg: uniform(0 90)}\n")));
}

TEST(ScenarioReading, TheSeaAloneHasAnAbsoluteLevel) {
  const std::string sea = "seaglint: 1\ntargets: {}\n";
  EXPECT_EQ(complaint_about(sea),
            "folder/file.yaml:1:1: clutter.level: must be nrl, git, hyb or tsc with targets: {}; scr is a ratio to a "
            "target");
  EXPECT_EQ(
      complaint_about(sea + "clutter: {level: scr}\n"),
      "folder/file.yaml:3:18: clutter.level: value 'scr': must be nrl, git, hyb or tsc with targets: {}; scr is a "
      "ratio to a target");
  EXPECT_EQ(
      complaint_about(sea + "clutter: {level: nrl, noise_level: snr}\n"),
      "folder/file.yaml:3:36: clutter.noise_level: value 'snr': must be cnr or thermal with targets: {}; snr is a "
      "ratio to a target");
  EXPECT_EQ(
      complaint_about(sea + "clutter: {enabled: false}\n"),
      "folder/file.yaml:3:20: clutter.enabled: value 'false': must be true, or noise_level thermal, with targets: "
      "{}; nothing else has an echo");
  EXPECT_HAS(complaint_about(sea + "clutter: {level: 'choice(nrl, scr)'}\n"), "scr is a ratio to a target");
  parse(sea + "clutter: {enabled: false, noise_level: thermal}\n");
  EXPECT_EQ(complaint_about("seaglint: 1\ntargets:\n"),
            "folder/file.yaml:2:1: targets: no value: must be a map of 1 to 100 named maps, or {}: the sea alone");
  EXPECT_EQ(complaint_about("seaglint: 1\ntargets: {}\nclutter: {level: nrl}\n", {{"targets.sea.label", "0"}}),
            "--set targets.sea.label: targets.sea: must have a mesh, a ship, a decoy or points");
}

// Names are written into JSON, which contains only UTF-8.
TEST(ScenarioReading, TextIsUtf8) {
  EXPECT_EQ(parse(kShort + "name: caf\xc3\xa9\n").name, "caf\xc3\xa9");
  EXPECT_EQ(complaint_about(kShort + "name: caf\xe9\n"), "folder/file.yaml:4:10: byte 0xe9: not a text in UTF-8");
  EXPECT_EQ(complaint_about(kShort, {{"name", "caf\xe9"}}), "--set name=caf: byte 0xe9: must be UTF-8");
  EXPECT_EQ(complaint_about(kShort, {{"targets.\xff.label", "1"}}), "--set targets.: byte 0xff: must be UTF-8");
  EXPECT_EQ(parse_scenario(kShort, "folder/caf\xe9.yaml").name, "caf_");
}

TEST(ScenarioReading, ADirectionIsListedOnceInASweep) {
  EXPECT_EQ(complaint_about(kShort + "view: {azimuth_deg: [30, -330]}\n"),
            "folder/file.yaml:4:21: view.azimuth_deg: -330 and 30 are the same direction: list it once");
  EXPECT_HAS(complaint_about(kShort + "view: {azimuth_deg: 0:360:10}\n"), "0 and 360 are the same direction");
  EXPECT_HAS(complaint_about(kShort + "view: {azimuth_deg: [-180, 90, 180]}\n"), "-180 and 180 are the same direction");
  EXPECT_HAS(complaint_about(kShort + "sea: {propagation_deg: [270, -90]}\n"),
             "sea.propagation_deg: -90 and 270 are the same direction");
  EXPECT_EQ(complaint_about(kShort + "view: {azimuth_deg: -180:179.9:0.1}\n"), "accepted");
  EXPECT_EQ(complaint_about(kShort + "view: {azimuth_deg: -360}\n"), "accepted");
}

TEST(ScenarioReading, PointsAreTargets) {
  const Scenario scenario = parse(
      "seaglint: 1\ntargets:\n  p:\n    label: 0\n    points:\n"
      "      - {position_m: [1, 2, 3], amplitude_m: 0.5, velocity_mps: [-1, 0, 0.25]}\n      - {position_m: [0, 0, "
      "0]}\n");
  ASSERT_EQ(scenario.targets[0].points.size(), 2u);
  EXPECT_THAT(scenario.targets[0].points[0].position_m, ElementsAre(1, 2, 3));
  EXPECT_EQ(scenario.targets[0].points[0].amplitude_m, 0.5);
  EXPECT_THAT(scenario.targets[0].points[0].velocity_mps, ElementsAre(-1, 0, 0.25));
  EXPECT_EQ(scenario.targets[0].points[1].amplitude_m, 1);
}

TEST(ScenarioReading, TheRadarChainsContradictionsAreNamed) {
  const std::pair<std::vector<Override>, const char*> cases[] = {
      {{{"radar.pri_jitter_us", "108"}}, "radar.pri_jitter_us: value '108': pulses would overlap: must be at most"},
      {{{"radar.hop_code", "file"}}, "radar.hop_code_file: this key is missing"},
      {{{"radar.hop_code_file", "codes.txt"}}, "radar.hop_code_file: value 'codes.txt': not allowed here"},
      {{{"radar.hop_code", "file"}, {"radar.hop_code_file", "none.txt"}},
       "radar.hop_code_file: value 'none.txt': no such file"},
      {{{"map.range_span_m", "40000"}}, "map.range_span_m: value '40000': its echo lasts 302.8"},
      {{{"clutter.level", "nrl"}, {"radar.polarisation", "hv"}}, "radar.polarisation: value 'hv': must be hh or vv"},
      {{{"clutter.level", "git"}, {"view.elevation_deg", "12"}}, "must be within 0.1 and 10 with clutter.level: git"},
      {{{"clutter.level", "hyb"}, {"radar.carrier_ghz", "36"}}, "must be within 0.5 and 35 with clutter.level: hyb"},
      {{{"clutter.level", "tsc"}, {"clutter.sea_state", "0.5"}}, "must be at least 1 with clutter.level: tsc"},
      {{{"clutter.level", "tsc"}, {"sea.significant_wave_height_m", "0.05"}},
       "must be at least 0.0667 with clutter.level: tsc, sea state 1"},
      {{{"clutter.level", "nrl"}, {"radar.carrier_ghz", "94"}},
       "radar.carrier_ghz: value '94': all carriers with their band, 93.9875 to 94.1875 GHz, must be within 0.5"},
      {{{"clutter.level", "nrl"}, {"radar.carrier_ghz", "34.9"}},
       "radar.carrier_ghz: value '34.9': all carriers with their band, 34.8875 to 35.0875 GHz, must be within 0.5"},
      {{{"radar.carrier_ghz", "0.1"}, {"radar.bandwidth_mhz", "200"}, {"radar.sampling_mhz", "400"}},
       "radar.bandwidth_mhz: value '200': must be below twice radar.carrier_ghz, 200"},
      {{{"radar.pulse_width_us", "0.1"}},
       "radar.pulse_width_us: value '0.1': must be at least 0.16 us, 8 samples of radar.sampling_mhz"},
      {{{"clutter.level", "nrl"}, {"view", "{elevation_deg: 0}"}},
       "view.elevation_deg: value '0': must be within 0.1 and 60"},
      {{{"clutter.doppler", "wave_resolved"}, {"view", "{elevation_deg: [2, 90]}"}},
       "must be within 0.1 and 60 with clutter.doppler: wave_resolved"},
      {{{"clutter.doppler", "sea_state"}, {"view", "{elevation_deg: -1}"}},
       "view.elevation_deg: value '-1': must be within 0.1 and 60 with clutter.doppler: sea_state"},
      {{{"clutter.level", "nrl"}, {"sea", "{significant_wave_height_m: 7, peak_period_s: 14}"}},
       "sea.significant_wave_height_m: value '7': must be at most 6"},
      {{{"sea_reflection", "{enabled: true, surface_profile: waves}"}, {"view.elevation_deg", "11"}},
       "view.elevation_deg: value '11': must be at most 10 with sea_reflection.surface_profile: waves"},
      {{{"sea_reflection", "{enabled: true, surface_profile: waves}"}, {"radar.carrier_ghz", "60"}},
       "must be at most 40 with sea_reflection.surface_profile: waves"},
      {{{"sea_reflection", "{enabled: true, surface_profile: waves}"},
        {"view.elevation_deg", "9"},
        {"radar", "{range_km: 1, pulses: 1000, pri_us: 1000, platform: {velocity_mps: [-400, 0, 0]}}"}},
       "the radar is above 10 deg of elevation at the end of an interval of 1 s from 9 deg, not allowed with"},
      {{{"sea_reflection", "{enabled: true, surface_profile: waves, paths: direct_only}"}},
       "must be all with sea_reflection.surface_profile: waves, whose field is not divided"},
      {{{"sea_reflection", "{enabled: true, surface_profile: waves}"}, {"targets.a.motion.waves", "independent"}},
       "must be same_field with sea_reflection.surface_profile: waves"},
      {{{"targets.a.companions", "[{target: b}]"}}, "must be the name of another target"},
      {{{"targets.a.companions", "[{target: a}]"}}, "must be the name of another target"}};
  for (const auto& [overrides, message] : cases) EXPECT_HAS(complaint_about(kShort, overrides), message) << message;
  EXPECT_EQ(complaint_about(kShort, {{"clutter.level", "nrl"}}), "accepted");
  EXPECT_EQ(
      complaint_about("seaglint: 1\nview:\n  elevation_deg: 90\nclutter: {doppler: wave_resolved}\ntargets:\n  a: "
                      "{label: 1, mesh: a.glb}\n"),
      "folder/file.yaml:3:18: view.elevation_deg: value '90': must be within 0.1 and 60 with clutter.doppler: "
      "wave_resolved");
  // Clutter of a given ratio and Doppler spectrum is valid at any elevation, and disabled clutter sets no limit.
  EXPECT_EQ(complaint_about(kShort, {{"view.elevation_deg", "90"}}), "accepted");
  EXPECT_EQ(
      complaint_about(kShort, {{"view.elevation_deg", "90"}, {"clutter", "{enabled: false, doppler: wave_resolved}"}}),
      "accepted");
}

// A float and a body at rest have no speed through the water.
TEST(ScenarioReading, OnlyModelsUnderWayHaveASpeed) {
  for (const char* model : {"fixed", "float"}) {
    EXPECT_EQ(
        complaint_about(fmt::format(
            "seaglint: 1\ntargets:\n  a: {{label: 1, mesh: a.glb, motion: {{model: {}, speed_mps: 5}}}}\n", model)),
        fmt::format("folder/file.yaml:3:{}: targets.a.motion.speed_mps: value '5': must be 0 with model: {}, which "
                    "stays where it is in the water",
                    59 + std::string(model).size(), model));
  }
  for (const char* model : {"model: ship", "model: rao, file: a.re1", "model: series, file: a.csv"})
    EXPECT_EQ(complaint_about(fmt::format(
                  "seaglint: 1\ntargets:\n  a: {{label: 1, mesh: a.glb, motion: {{{}, speed_mps: 5}}}}\n", model)),
              "accepted");
}

TEST(ScenarioReading, OnlyFloatsDrift) {
  const auto complaint = [](const std::string& motion) {
    return complaint_about("seaglint: 1\ntargets:\n  a: {label: 1, mesh: a.glb, motion: {" + motion + "}}\n");
  };
  EXPECT_EQ(complaint("model: float, drift: {wind_mps: 10, leeway: 0.05, current_mps: 1, spread_mps: 0.1}"),
            "accepted");
  EXPECT_HAS(complaint("model: ship, drift: {wind_mps: 10}"),
             "targets.a.motion.drift: not allowed here: valid only with model: float, not ship");
  EXPECT_HAS(complaint("drift: {}"), "valid only with model: float, not fixed");
  EXPECT_HAS(complaint("model: float, drift: {leeway: .nan}"), "targets.a.motion.drift.leeway: value '.nan': must be");
}

// A float or a body at rest is towed by a target under way.
TEST(ScenarioReading, TowsAreByATargetUnderWayOfBodiesWithoutASpeed) {
  const auto complaint = [](const std::string& host, const std::string& towed) {
    return complaint_about("seaglint: 1\ntargets:\n  a: {label: 1, " + host +
                           ", companions: [{target: b, towed: true}]}\n  b: {label: 0, " + towed + "}\n");
  };
  const std::string ship = "mesh: a.glb, motion: {model: ship, speed_mps: 5}",
                    points = "points: [{position_m: [0, 0, 1]}]", decoy = "mesh: b.glb, motion: {model: float}",
                    key = "targets.a.companions.0.towed: ";
  for (const std::string& towed : {decoy, points, std::string("mesh: b.glb")}) {
    EXPECT_EQ(complaint(ship, towed), "accepted");
    EXPECT_EQ(complaint("mesh: a.glb, motion: {model: series, file: a.csv, speed_mps: 2}", towed), "accepted");
  }
  EXPECT_EQ(complaint("mesh: a.glb, motion: {model: ship}", decoy), "accepted");  // at a speed of 0
  for (const std::string& host :
       {points, decoy, std::string("mesh: a.glb"), std::string("mesh: a.glb, motion: {model: series, file: a.csv}")})
    EXPECT_HAS(complaint(host, decoy), key + "not allowed here: targets.a has no motion.speed_mps");
  EXPECT_HAS(complaint(ship, "mesh: b.glb, motion: {model: ship, speed_mps: 4}"),
             key +
                 "not allowed here: targets.b is of model ship, which has a speed of its own, "
                 "targets.b.motion.speed_mps 4");
  EXPECT_HAS(complaint(ship, "mesh: b.glb, motion: {model: float, drift: {}}"),
             key + "not allowed here: targets.b.motion.drift is the velocity of a free float");
}

TEST(ScenarioReading, IntraPulseMotionIsForPoints) {
  EXPECT_TRUE(parse("seaglint: 1\nradar: {intra_pulse_motion: true}\n"
                    "targets: {p: {label: 0, points: [{position_m: [0, 0, 0]}]}}\n")
                  .radar.intra_pulse_motion);
}

TEST(ScenarioReading, SweepsAreNumbersListsOrRangesInBlocksAndBraces) {
  const auto azimuths = [](const std::string& value) { return parse(kShort + value).view.azimuth_deg; };
  EXPECT_THAT(azimuths("view: {azimuth_deg: 30}"), ElementsAre(30));
  EXPECT_THAT(azimuths("view: {azimuth_deg: [3, -1.5]}"), ElementsAre(3, -1.5));
  EXPECT_THAT(azimuths("view: {azimuth_deg: 10:20:5}"), ElementsAre(10, 15, 20));
  EXPECT_THAT(azimuths("view: {azimuth_deg: '10:20:5', elevation_deg: 1}"), ElementsAre(10, 15, 20));
  EXPECT_THAT(azimuths("view:\n  azimuth_deg: 10:20:5\n"), ElementsAre(10, 15, 20));
}

TEST(ScenarioReading, TheWindSeaRuleIsAWordInPlaceOfAPeriod) {
  const Scenario scenario = parse(kShort + "sea: {peak_period_s: dnv_wind_sea, significant_wave_height_m: [1, 4]}");
  EXPECT_EQ(scenario.sea.period_rule, PeakPeriod::kDnvWindSea);
  const auto states = sea_states(scenario.sea);
  ASSERT_EQ(states.size(), 2u);
  EXPECT_DOUBLE_EQ(states[0].peak_period_s, 3.96);
  EXPECT_DOUBLE_EQ(states[1].peak_period_s, 7.92);
}

TEST(ScenarioReading, AnyPositiveHopStepIsAccepted) {
  EXPECT_EQ(parse(kShort + "radar: {hop_step_mhz: 1e-9}").radar.hop_step_mhz, 1e-9);
  EXPECT_EQ(parse(kShort + "radar: {hop_step_mhz: 33.3}").radar.hop_step_mhz, 33.3);
  EXPECT_EQ(complaint_about(kShort + "radar: {hop_step_mhz: 0}"),
            "folder/file.yaml:4:23: radar.hop_step_mhz: value '0': must be a number greater than 0");
}

TEST(ScenarioReading, AnAliasRepeatsAValue) {
  const Scenario scenario = parse(
      "seaglint: 1\ntargets:\n  a: {label: 1, mesh: a.glb, motion: &m {model: ship, roll_damping: 0.25}}\n"
      "  b: {label: 0, mesh: a.glb, motion: *m}\n");
  EXPECT_EQ(scenario.targets[1].motion.roll_damping, 0.25);
}

struct Mistake {
  std::string line;       // the fourth line of the file, after kShort
  std::string complaint;  // after "folder/file.yaml:4:"
};

TEST(ScenarioReading, EveryMistakeIsNamedWithItsPlaceValueAndBound) {
  const Mistake mistakes[] = {
      // Keys.
      {"radar: {carier_ghz: 16}", "9: radar.carier_ghz: unknown key: did you mean 'carrier_ghz'?"},
      {"radar: {carrier_mhz: 16}", "9: radar.carrier_mhz: unknown key: did you mean 'carrier_ghz'?"},
      {"view: {nonsense: 1}", "8: view.nonsense: unknown key: must be one of azimuth_deg, elevation_deg"},
      {"raddar: {}", "1: raddar: unknown key: did you mean 'radar'?"},
      {"radar: {pulses: 1, carrier_ghz: 16, pulses: 2}", "37: radar.pulses: this key appears twice, first in line 4"},
      {"seaglint: 1", "1: seaglint: this key appears twice, first in line 1"},
      {"view: {? [1] : 2}", "10: a key must be plain text"},
      // Types.
      {"radar: 5", "8: radar: value '5': must be a map of key: value"},
      {"radar: [1]", "8: radar: a list: must be a map of key: value"},
      {"radar:", "1: radar: no value: must be a map of key: value"},
      {"radar: {carrier_ghz: 16 GHz}", "22: radar.carrier_ghz: value '16 GHz': must be a number within 0.1 and 300"},
      {"radar: {carrier_ghz: '16'}", "22: radar.carrier_ghz: value '16': must be a number within 0.1 and 300"},
      {"radar: {carrier_ghz: [16]}", "22: radar.carrier_ghz: a list: must be a number within 0.1 and 300"},
      {"radar: {carrier_ghz: {}}", "22: radar.carrier_ghz: a map: must be a number within 0.1 and 300"},
      {"radar: {carrier_ghz: }", "9: radar.carrier_ghz: no value: must be a number within 0.1 and 300"},
      {"radar: {carrier_ghz: .nan}", "22: radar.carrier_ghz: value '.nan': must be a number within 0.1 and 300"},
      {"radar: {carrier_ghz: nan}", "22: radar.carrier_ghz: value 'nan': must be a number within 0.1 and 300"},
      {"radar: {carrier_ghz: .inf}", "22: radar.carrier_ghz: value '.inf': must be a number within 0.1 and 300"},
      {"radar: {hop_step_mhz: inf}", "23: radar.hop_step_mhz: value 'inf': must be a number greater than 0"},
      {"radar: {pulses: 2.5}", "17: radar.pulses: value '2.5': must be a whole number within 1 and 1048576"},
      {"radar: {pulses: 99999999999999999999}",
       "17: radar.pulses: value '99999999999999999999': must be a whole number within 1 and 1048576"},
      {"radar: {polarisation: xx}", "23: radar.polarisation: value 'xx': must be one of hh, hv, vh, vv"},
      {"radar: {intra_pulse_motion: yes}", "29: radar.intra_pulse_motion: value 'yes': must be true or false"},
      {"learning: {fusion: both}", "20: learning.fusion: value 'both': must be split or in_sample"},
      {"name: [a]", "7: name: a list: must be a text of 1 to 4096 printable characters"},
      {"name: \"a\\nb\"", "7: name: value 'a b': must be a text of 1 to 4096 printable characters"},
      {"seed: -1", "7: seed: value '-1': must be a whole number within 0 and 9223372036854775807"},
      {"seed: 9223372036854775808",
       "7: seed: value '9223372036854775808': must be a whole number within 0 and 9223372036854775807"},
      {"dataset: {split: 0.7}", "18: dataset.split: value '0.7': must be a ratio a:b of two positive numbers"},
      {"dataset: {split: 0:1}", "18: dataset.split: value '0:1': must be a ratio a:b of two positive numbers"},
      {"radar: {pulses: !!int 5}", "17: tag 'tag:yaml.org,2002:int': tags are not used here"},
      // Bounds.
      {"radar: {carrier_ghz: 400}", "22: radar.carrier_ghz: value '400': must be a number within 0.1 and 300"},
      {"radar: {pulses: 0}", "17: radar.pulses: value '0': must be a whole number within 1 and 1048576"},
      {"learning: {map_floor_db: 0}",
       "26: learning.map_floor_db: value '0': must be a number at least -120 and less than 0"},
      {"learning: {subsample: 0}", "23: learning.subsample: value '0': must be a number greater than 0 and at most 1"},
      {"sea: {significant_wave_height_m: -1}",
       "34: sea.significant_wave_height_m: value '-1': must be a number, a list or from:to:step, 0 or within 1e-06 and "
       "30, or from_table"},
      // Sweeps.
      {"view: {azimuth_deg: [1, x]}", "25: view.azimuth_deg: value 'x': must be a list of numbers within -360 and 360"},
      {"view: {azimuth_deg: [1, 400]}",
       "25: view.azimuth_deg: value '400': must be a list of numbers within -360 and 360"},
      {"view: {azimuth_deg: []}", "21: view.azimuth_deg: a list: must be a list of 1 to 10000 numbers"},
      {"view: {azimuth_deg: [1, 2, 1]}", "21: view.azimuth_deg: value '1' appears twice"},
      {"view: {azimuth_deg: 1:2}", "21: view.azimuth_deg: value '1:2': must be a number or from:to:step"},
      {"view: {azimuth_deg: 0:360:0.001}",
       "21: view.azimuth_deg: value '0:360:0.001': must be a range of at most 10000 values"},
      {"view: {azimuth_deg: 0:400:100}",
       "21: view.azimuth_deg: value '0:400:100': must be a number, a list or from:to:step, within -360 and 360"},
      {"sea: {peak_period_s: dnv}",
       "22: sea.peak_period_s: value 'dnv': must be a number, a list or from:to:step, within 0.5 and 40, or "
       "dnv_wind_sea or wind_and_fetch"},
      // Contradictions.
      {"radar: {pulse_width_us: 300}", "25: radar.pulse_width_us: value '300': must be shorter than radar.pri_us, 250"},
      {"radar: {pri_us: 36}", "8: radar.pulse_width_us: must be shorter than radar.pri_us, 36"},
      {"radar: {bandwidth_mhz: 60}", "24: radar.bandwidth_mhz: value '60': must be at most radar.sampling_mhz, 50"},
      {"radar: {intra_pulse_motion: true}",
       "29: radar.intra_pulse_motion: value 'true': must be false with a mesh, here targets.a: only points move during "
       "a pulse"},
      {"dataset: {maps_per_case: 15}",
       "26: dataset.maps_per_case: value '15': must be a multiple of dataset.realisations_per_case, 10"},
      {"dataset: {maps_per_case: 5}",
       "26: dataset.maps_per_case: value '5': must be a multiple of dataset.realisations_per_case, 10"},
      {"sea: {significant_wave_height_m: 2, peak_period_s: 2}",
       "34: sea.significant_wave_height_m: value '2': waves of 2 m break at a peak period of 2 s: must be at most "
       "0.8922 m"},
      {"sea: {significant_wave_height_m: 0, peak_period_s: dnv_wind_sea}",
       "34: sea.significant_wave_height_m: value '0': must be greater than 0 with peak_period_s: dnv_wind_sea"},
      {"view: {azimuth_deg: 0:360:0.1, elevation_deg: 0:90:0.1}",
       "21: view.azimuth_deg: value '0:360:0.1': the sweeps of view and sea span 3244501 cases: must be at most "
       "1000000"},
      // Not YAML.
      {"radar: {pulses: 1, ]}", "20: not valid YAML: illegal flow end"},
      {"radar: *none", "8: not valid YAML: the referenced anchor is not defined"},
      {"view: &v {azimuth_deg: *v}", "24: an alias inside the value it names"},
      {"--- {}", "5: a second document: only one is allowed"},
      {"name: a\x01", "8: byte 0x01: not a text file"},
  };
  for (const Mistake& mistake : mistakes) {
    EXPECT_EQ(complaint_about(kShort + mistake.line + "\n"), fmt::format("folder/file.yaml:4:{}", mistake.complaint))
        << mistake.line;
  }
}

TEST(ScenarioReading, EveryMistakeInATargetIsNamed) {
  const Mistake mistakes[] = {
      {"  t: {mesh: a.glb}", "6: targets.t.label: this key is missing"},
      {"  t: {label: ship, mesh: a.glb}", "14: targets.t.label: value 'ship': must be a whole number within 0 and 9"},
      {"  t: {label: 1}", "6: targets.t: must have a mesh, a ship, a decoy or points"},
      {"  t: {label: 1, mesh: a.glb, points: [{position_m: [0, 0, 0]}]}",
       "6: targets.t: must have a mesh, a ship, a decoy or points, one of them only"},
      {"  t: {label: 1, motion: {}, points: [{position_m: [0, 0, 0]}]}",
       "25: targets.t.motion: not allowed here: valid only with a mesh"},
      {"  t: {label: 1, points: []}", "25: targets.t.points: a list: must be a list of 1 to 10000 maps"},
      {"  t: {label: 1, points: [{}]}", "26: targets.t.points.0.position_m: this key is missing"},
      {"  t: {label: 1, points: [{position_m: [0, 0]}]}",
       "39: targets.t.points.0.position_m: a list: must be a list of three numbers [x, y, z]"},
      {"  t: {label: 1, points: [{position_m: [0, 0, x]}]}",
       "46: targets.t.points.0.position_m.2: value 'x': must be a number within -100000 and 100000"},
      {"  t: {label: 1, mesh: a.glb, layout: {}}", "38: targets.t.layout.line: this key is missing"},
      {"  t: {label: 1, mesh: a.glb, layout: {ring: {}}}",
       "39: targets.t.layout.ring: unknown key: must be one of area, line, bodies, heights, headings, scales, "
       "jitter_m, tether_slack, seed"},
      {"  t: {label: 1, mesh: a.glb, orientation: {forward: +y, up: -y}}",
       "43: targets.t.orientation: forward +y and up -y must be perpendicular to each other"},
      {"  t: {label: 1, mesh: a.glb, orientation: {forward: y}}",
       "53: targets.t.orientation.forward: value 'y': must be one of +x, -x, +y, -y, +z, -z"},
      {"  t: {label: 1, mesh: a.glb, offset_m: [0, 1]}",
       "40: targets.t.offset_m: a list: must be a list of three numbers [x, y, z]"},
      {"  t: {label: 1, points: [{position_m: [0, 0, 0]}], offset_m: [0, 1, 0]}",
       "62: targets.t.offset_m: not allowed here: valid only with a mesh"},
      {"  t: {label: 1, mesh: a.glb, unit: yd}",
       "36: targets.t.unit: value 'yd': must be one of m, cm, mm, km, in, ft"},
      {"  t: {label: 1, mesh: a.glb, motion: {roll_period_s: 0.1}}",
       "54: targets.t.motion.roll_period_s: value '0.1': must be 0 or a number within 0.2 and 60"},
      {"  t.u: {label: 1, mesh: a.glb}", "3: targets: name 't.u': must be 1 to 64 letters, digits, '_' or '-'"},
      {"  t: 5", "6: targets.t: value '5': must be a map of key: value"},
      {"  a: {label: 1, mesh: b.glb}", "3: targets.a: this key appears twice, first in line 3"},
  };
  for (const Mistake& mistake : mistakes) {
    EXPECT_EQ(complaint_about(kShort + mistake.line + "\n"), fmt::format("folder/file.yaml:4:{}", mistake.complaint))
        << mistake.line;
  }
  EXPECT_EQ(complaint_about("seaglint: 1\n"),
            "folder/file.yaml:1:1: targets: this key is missing; targets: {} is the sea alone");
  EXPECT_EQ(complaint_about("seaglint: 1\ntargets: []\n"),
            "folder/file.yaml:2:10: targets: a list: must be a map of 1 to 100 named maps, or {}: the sea alone");
  EXPECT_EQ(complaint_about("targets: {}\n"), "folder/file.yaml:1:1: seaglint: this key is missing");
  EXPECT_EQ(complaint_about("seaglint: 2\ntargets: {}\n"), "folder/file.yaml:1:11: seaglint: value '2': must be 1");
}

TEST(ScenarioReading, FilesThatAreNoScenarioHaveAClearError) {
  EXPECT_EQ(complaint_about(""), "folder/file.yaml: the file is empty: must be a map of key: value");
  EXPECT_EQ(complaint_about("# nothing\n\n"), "folder/file.yaml: the file is empty: must be a map of key: value");
  EXPECT_EQ(complaint_about("just words"), "folder/file.yaml:1:1: value 'just words': must be a map of key: value");
  EXPECT_EQ(complaint_about("- 1\n"), "folder/file.yaml:1:1: a list: must be a map of key: value");
  EXPECT_EQ(complaint_about(std::string("\x89PNG\r\n\x1a\n\0\0", 10)),
            "folder/file.yaml:1:1: byte 0x89: not a text in UTF-8");
  EXPECT_EQ(complaint_about(std::string("s\0e\0", 4)), "folder/file.yaml:1:2: byte 0x00: not a text file");
  EXPECT_THAT(complaint_about("\xff\xfe\xfd\x80"), StartsWith("folder/file.yaml:1:"));
}

TEST(ScenarioReading, HostileFilesAreRefusedBeforeExpansion) {
  EXPECT_EQ(complaint_about(std::string(kMaxYamlBytes + 1, ' ')),
            "folder/file.yaml: has 4000001 bytes, more than the limit of 4000000");
  EXPECT_HAS(complaint_about(std::string(100000, '[')), "nested deeper than 32 levels");
  EXPECT_THAT(complaint_about(std::string(100000, '{')), StartsWith("folder/file.yaml:1:"));
  std::string nested;
  for (int depth = 0; depth < 2500; ++depth) nested += fmt::format("{:{}}a:\n", "", depth);
  EXPECT_HAS(complaint_about(nested), "nested deeper than 32 levels");
  std::string many = "seaglint: [";
  for (int i = 0; i < 400000; ++i) many += "1,";
  EXPECT_HAS(complaint_about(many + "]"), "more than 300000 values");
  // Each line contains the one before ten times: 10^12 values if all were expanded.
  std::string laughs = "a0: &a0 x\n";
  for (int i = 1; i <= 12; ++i) {
    laughs += fmt::format("a{}: &a{} [", i, i);
    for (int k = 0; k < 10; ++k) laughs += fmt::format("*a{}{}", i - 1, k < 9 ? "," : "]\n");
  }
  EXPECT_HAS(complaint_about(laughs), "more than 300000 values");
}

TEST(ScenarioReading, MaterialsOfATargetAndItsPartsRoundTrip) {
  const Scenario scenario = parse(
      "seaglint: 1\ntargets:\n  a: {label: 1, mesh: a.glb, material: aluminium, part_materials: [{part: mast*, "
      "material: m.yaml}]}\n");
  ASSERT_EQ(scenario.targets[0].part_materials.size(), 1u);
  EXPECT_EQ(scenario.targets[0].material, "aluminium");
  EXPECT_EQ(scenario.targets[0].part_materials[0].part, "mast*");
  const Scenario again = parse(effective_yaml(scenario));
  EXPECT_EQ(again.targets[0].part_materials[0].material, "m.yaml");
  EXPECT_EQ(parse(kShort).targets[0].material, "pec");
}

TEST(ScenarioReading, OneMapHasOneRadarRange) {
  const auto with = [](const std::string& ship, const std::string& decoy) {
    return "seaglint: 1\ntargets:\n  ship: {label: 1, " + ship +
           ", companions: [{target: decoy}]}\n  decoy: {label: 0, " + decoy + "}\n";
  };
  const std::string mesh = "mesh: a.glb", far = "mesh: a.glb, solver: {wavefront_range_m: 20000}",
                    near = "mesh: a.glb, solver: {wavefront_range_m: 5000.5}",
                    points = "points: [{position_m: [0, 0, 0]}]";
  EXPECT_EQ(
      complaint_about(with(far, near)),
      "folder/file.yaml:4:62: targets.decoy.solver.wavefront_range_m: value '5000.5': must be 20000, as targets.ship "
      "has it in the same maps (folder/file.yaml:3:61: targets.ship.solver.wavefront_range_m)");
  EXPECT_HAS(complaint_about(with(far, mesh)), "4:10: targets.decoy.solver.wavefront_range_m: must be 20000");
  EXPECT_HAS(complaint_about(with(mesh, far)), "targets.decoy.solver.wavefront_range_m: value '20000': must be 0");
  EXPECT_HAS(complaint_about(with(far, points)),
             "3:61: targets.ship.solver.wavefront_range_m: value '20000': must be 0, as targets.decoy has it");
  EXPECT_HAS(complaint_about(with(points, far)),
             "4:62: targets.decoy.solver.wavefront_range_m: value '20000': must be 0");
  EXPECT_EQ(complaint_about(with(far, far)), "accepted");
  EXPECT_EQ(complaint_about(with(points, points)), "accepted");
}

TEST(ScenarioReading, ThicknessOfSheetsBelongsToAMesh) {
  const auto with = [](const std::string& keys) {
    return "seaglint: 1\ntargets:\n  a: {label: 1, " + keys + ", sheet_thickness_mm: 1.5}\n";
  };
  EXPECT_DOUBLE_EQ(parse(effective_yaml(parse(with("mesh: a.glb")))).targets[0].sheet_thickness_mm, 1.5);
  EXPECT_HAS(complaint_about(with("points: [{position_m: [0, 0, 0]}]")),
             "sheet_thickness_mm: value '1.5': not allowed here: valid only with a mesh");
}

}  // namespace
}  // namespace seaglint

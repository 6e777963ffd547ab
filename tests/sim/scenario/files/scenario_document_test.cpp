// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/material_spec.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// YAML text: what is read, refused and limited; modified and random texts.

TEST(ScenarioYaml, AMergeKeyAddsTheEntriesThatTheMapLacks) {
  const auto motions = [](const std::string& second) {
    return parse(
               "seaglint: 1\ntargets:\n  a: &a {label: 1, mesh: a.glb, motion: &m {model: ship, roll_damping: 0.25}}\n"
               "  b: " +
               second + "\n")
        .targets[1];
  };
  EXPECT_EQ(motions("{<<: *a, label: 0}").motion.roll_damping, 0.25);
  EXPECT_EQ(motions("{<<: *a, label: 0}").label, 0);
  EXPECT_EQ(motions("{label: 0, <<: *a}").label, 0);
  EXPECT_EQ(motions("{label: 0, mesh: b.glb, motion: {<<: *m, roll_damping: 0.5}}").motion.roll_damping, 0.5);
  EXPECT_EQ(motions("{<<: [{label: 0}, *a]}").label, 0);
  EXPECT_EQ(motions("\n    <<: *a\n    label: 0").mesh, "a.glb");
  EXPECT_EQ(complaint_about(kShort + "radar: {<<: 3}"),
            "folder/file.yaml:4:9: the value of << must be a map or a list of maps");
  EXPECT_EQ(complaint_about(kShort + "radar: {<<: {pulses: 8}, <<: {pulses: 9}}"),
            "folder/file.yaml:4:26: the key << appears twice");
  EXPECT_HAS(complaint_about(kShort + "radar: {<<: {pulse: 8}}"), "radar.pulse: unknown key");
  EXPECT_HAS(complaint_about(kShort + "radar: {\"<<\": {pulses: 8}}"), "unknown key");
}

TEST(ScenarioYaml, BooleansHaveTheSpellingsOfYaml) {
  for (const char* word : {"true", "True", "TRUE"})
    EXPECT_TRUE(parse(kShort + "sea_reflection: {enabled: " + word + "}").sea_reflection.enabled) << word;
  for (const char* word : {"false", "False", "FALSE"})
    EXPECT_FALSE(parse(kShort + "sea_reflection: {enabled: " + word + "}").sea_reflection.enabled) << word;
  for (const char* word : {"tRUE", "yes", "on", "1", "'true'"})
    EXPECT_HAS(complaint_about(kShort + "sea_reflection: {enabled: " + word + "}"), "must be true or false");
}

TEST(ScenarioYaml, OtherEncodingsAreNamed) {
  EXPECT_EQ(parse("\xef\xbb\xbf" + kShort).targets.size(), 1u);
  EXPECT_EQ(complaint_about(std::string("\xff\xfes\0e\0a\0", 8)),
            "folder/file.yaml: no plain text: it is a text in UTF-16: save it as UTF-8");
}

TEST(ScenarioYaml, CharactersThatLookLikeOthersAreNamed) {
  const std::string file = SEAGLINT_SOURCE_DIR "/tests/cases/tables/nbsp_indent.yaml";
  try {
    read_scenario(file);
    ADD_FAILURE() << file;
  } catch (const InputError& error) {
    EXPECT_HAS(error.what(), "nbsp_indent.yaml:3:1: ");
    EXPECT_HAS(error.what(), "unknown key: it has U+00A0, a no-break space; keys are indented by blanks");
  }
  EXPECT_HAS(complaint_about(kShort + "radar: {pulses: 64\xc2\xa0}"), "; it has U+00A0, a no-break space");
  EXPECT_HAS(complaint_about(kShort + "view: {elevation_deg: \xe2\x88\x92"
                                      "2}"),
             "; it has U+2212, a minus sign");
  EXPECT_HAS(complaint_about(kShort + "sea:\n  order: 1\n \xc2\xa0"
                                      "components: 3\n"),
             "U+00A0");
}

const std::string kSeedText = R"(seaglint: 1
name: "quoted \"name\""
radar: &r {carrier_ghz: 16, hop_code: random, pulses: 256, intra_pulse_motion: false}
view:
  azimuth_deg: 10:170:10
  elevation_deg: [1, 2]
sea: {peak_period_s: dnv_wind_sea, gamma: 3.3}
targets:
  ship: {label: 1, mesh: a.glb, motion: {model: ship, rotation_centre_m: [1, 2, 3]}}
  array: {label: 0, mesh: b.glb, layout: {line: {count: 4, spacing_m: 40}}}
  points:
    label: 0
    points:
      - {position_m: [0, 0, 0], velocity_mps: [1, 0, 0]}
dataset: {split: 7:3}
)";

const char* const kPieces[] = {
    "[",  "]",  "{",  "}",  ":",   ": ",   "- ",   "? ",   "&r ",  "*r",    "!!int ", "!",   "'",         "\"",
    "\n", "  ", "\t", "#",  "---", "...",  "|",    ">",    "<<: ", "%YAML", ",",      "~",   "null",      "1e999",
    "-",  ".",  "0x", "\\", "\r",  "\x00", "\xc3", "\xff", "@",    "`",     "|+9\n",  "inf", "9999999999"};

std::string mutated(std::uint64_t index) {
  Random random({2, Stream::kTest, index});
  std::string text = kSeedText;
  const std::uint32_t changes = 1 + random.below(6);
  for (std::uint32_t i = 0; i < changes; ++i) {
    const auto position = [&] {
      return static_cast<std::size_t>(random.below(static_cast<std::uint32_t>(text.size()) + 1));
    };
    const std::size_t at = position(), length = std::min<std::size_t>(random.below(20), text.size() - at);
    switch (random.below(5)) {
      case 0: text.insert(at, kPieces[random.below(std::size(kPieces))]); break;
      case 1: text.erase(at, length); break;
      case 2: text.insert(position(), text.substr(at, length)); break;
      case 3: text.replace(at, length, kPieces[random.below(std::size(kPieces))]); break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(random.below(256));
    }
  }
  return text;
}

TEST(ScenarioFuzzing, BrokenScenariosAreReadOrRefusedWithAnInputError) {
  int read = 0, refused = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const std::string text = mutated(i);
    try {
      parse_scenario(text, "file.yaml", {{"radar.pulses", i % 3 == 0 ? text.substr(0, 40) : "64"}});
      ++read;
    } catch (const InputError& error) {
      ASSERT_GT(std::string(error.what()).size(), 10u);
      ++refused;
    } catch (const std::exception& error) {
      FAIL() << "mutation " << i << ": " << error.what() << "\n" << text;
    }
  }
  // Both outcomes occur: the mutations are neither all harmless nor all invalid.
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 5000);
}

TEST(ScenarioFuzzing, PiecesOfYamlAloneAreRefusedWithAnInputError) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    Random random({3, Stream::kTest, i});
    std::string text;
    for (std::uint32_t k = random.below(30); k > 0; --k) text += kPieces[random.below(std::size(kPieces))];
    try {
      parse_scenario(text, "file.yaml");
      FAIL() << "read: " << text;
    } catch (const InputError&) {
    } catch (const std::exception& error) {
      FAIL() << "mutation " << i << ": " << error.what() << "\n" << text;
    }
  }
}

// Overrides of --set, and the errors of a file, which are reported all at once.

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
  EXPECT_EQ(complaint("radar.pulses", "0"),
            "--set radar.pulses: value '0': must be a whole number within 1 and 1048576");
  EXPECT_EQ(complaint("radar.pulse", "5"), "--set radar.pulse: unknown key: did you mean 'pulses'?");
  EXPECT_EQ(complaint("rader.pulses", "5"), "--set rader.pulses: rader: unknown key: did you mean 'radar'?");
  EXPECT_EQ(complaint("radar", "{pulses: x}"),
            "--set radar: radar.pulses: value 'x': must be a whole number within 1 and 1048576");
  EXPECT_EQ(complaint("radar", "{pulses: 1, pulses: 2}"),
            "--set radar: radar.pulses: this key appears twice, first in line 1");
  EXPECT_EQ(complaint("radar.pulses.x", "5"), "--set radar.pulses.x: there is nothing below the value '256'");
  EXPECT_EQ(complaint("radar.pulses", ""), "--set radar.pulses: no value: must be a whole number within 1 and 1048576");
  EXPECT_EQ(complaint("radar.pulses", "[1"), "--set radar.pulses: value '[1': not valid YAML");
  EXPECT_EQ(complaint("radar.pulse_width_us", "300"),
            "--set radar.pulse_width_us: value '300': must be shorter than radar.pri_us, 250");
  EXPECT_EQ(complaint("", "5"), "--set : must be key.path=value");
  EXPECT_EQ(complaint("radar..pulses", "5"), "--set radar..pulses: must be key.path=value");
  EXPECT_EQ(complaint("targets.boat.label", "1"),
            "--set targets.boat.label: targets.boat: must have a mesh, a ship, a decoy or points");
}

std::vector<std::string> errors_of(const std::string& yaml, const std::vector<Override>& overrides = {}) {
  try {
    parse(yaml, overrides);
  } catch (const InputError& error) {
    return messages_of(error);
  }
  return {};
}

TEST(AllErrors, OfAFileAreReportedInItsOrder) {
  const std::string yaml = R"(seaglint: 1
radar: {carier_ghz: 16, pulses: many, hop_code: rondom, pri_us: 250, pri_us: 300}
targets:
  a: {label: 1, mesh: a.glb, motion: {model: shop}, scale: 1e9}
  b: {mesh: b.glb, layout: [1]}
view: {azimuth_deg: [10, 10], elevation_deg: 95}
sea: {peak_period_s: uniform(9, 7), gamma: 0.5}
map: {range_span_m: 40000}
)";
  EXPECT_THAT(
      errors_of(yaml),
      ElementsAre(AllOf(StartsWith("folder/file.yaml:2:9: radar.carier_ghz: unknown key"), HasSubstr("carrier_ghz")),
                  StartsWith("folder/file.yaml:2:33: radar.pulses: value 'many'"),
                  StartsWith("folder/file.yaml:2:49: radar.hop_code: value 'rondom'"),
                  StartsWith("folder/file.yaml:2:70: radar.pri_us: this key appears twice"),
                  StartsWith("folder/file.yaml:4:46: targets.a.motion.model: value 'shop'"),
                  StartsWith("folder/file.yaml:4:60: targets.a.scale: value '1e9'"),
                  StartsWith("folder/file.yaml:5:6: targets.b.label: this key is missing"),
                  StartsWith("folder/file.yaml:5:28: targets.b.layout: a list"),
                  StartsWith("folder/file.yaml:6:21: view.azimuth_deg: value '10' appears twice"),
                  StartsWith("folder/file.yaml:6:46: view.elevation_deg: value '95'"),
                  StartsWith("folder/file.yaml:7:22: sea.peak_period_s: value 'uniform(9'"),
                  StartsWith("folder/file.yaml:7:44: sea.gamma: value '0.5'")));
}

TEST(AllErrors, AreLinesOfOneInputError) {
  const std::string yaml = kShort + "seed: -1\nview: {elevation_deg: 95}\n";
  EXPECT_EQ(complaint_about(yaml), fmt::format("{}\n{}", errors_of(yaml)[0], errors_of(yaml)[1]));
}

// A wrong value hides no contradiction of other keys, and causes none.
TEST(AllErrors, AreWithoutThoseThatFollowFromOthers) {
  EXPECT_THAT(errors_of(kShort + "radar: {pulse_width_us: 300, hop_code_file: c.txt}\nview: {azimuth_deg: [0, 360]}\n"
                                 "dataset: {maps_per_case: 7, realisations_per_case: 2}\n"),
              ElementsAre(HasSubstr("radar.pulse_width_us: value '300': must be shorter than radar.pri_us"),
                          HasSubstr("radar.hop_code_file: value 'c.txt': not allowed here"),
                          HasSubstr("0 and 360 are the same direction"),
                          HasSubstr("dataset.maps_per_case: value '7': must be a multiple")));
  EXPECT_THAT(errors_of(kShort + "radar: {sampling_mhz: 1}\n"),
              ElementsAre(HasSubstr("radar.bandwidth_mhz: must be at most radar.sampling_mhz")));
  EXPECT_THAT(errors_of("seaglint: 1\ntargets:\n  a: {lable: 1, mesh: a.glb}\n"),
              ElementsAre(HasSubstr("targets.a.lable: unknown key: did you mean 'label'?")));
  EXPECT_THAT(errors_of("seaglint: 1\ntargets:\n  a: {role: prt, mesh: a.glb}\n  b: {label: 1, mesh: b.glb}\n"),
              ElementsAre(HasSubstr("targets.a.role: value 'prt': must be class or part")));
  EXPECT_THAT(errors_of("seaglint: 1\ntarget:\n  a: {label: 1, mesh: a.glb}\n"),
              ElementsAre(HasSubstr("target: unknown key: did you mean 'targets'?")));
  EXPECT_THAT(errors_of(kShort + "sea: {significant_wave_height_m: 9, peak_perod_s: 12}\n"),
              ElementsAre(HasSubstr("sea.peak_perod_s: unknown key: did you mean 'peak_period_s'?")));
  EXPECT_THAT(errors_of(kShort + "sea: {spectrum: jonswp, table: s.csv}\n"),
              ElementsAre(HasSubstr("sea.spectrum: value 'jonswp'")));
}

// No list of sea states is made where the sweeps span too many.
TEST(AllErrors, OfSweepsThatSpanTooManyCasesAreFoundBesideOthers) {
  EXPECT_THAT(errors_of("seaglint: 1\nsea: {significant_wave_height_m: 0.001:5:0.001, peak_period_s: 10:30:0.01, "
                        "gamma: 1:19:0.01}\ntargets:\n  a: {label: x, mesh: a.glb}\n"),
              ElementsAre(HasSubstr("the sweeps of view and sea span"), HasSubstr("targets.a.label: value 'x'")));
}

TEST(AllErrors, OfOverridesFollowThoseOfTheFile) {
  EXPECT_THAT(errors_of(kShort + "seed: x\n", {{
                                                   "radar.pulses",
                                                   "[",
                                               },
                                               {"view.elevation_deg", "95"},
                                               {"a..b", "1"}}),
              testing::UnorderedElementsAre(StartsWith("folder/file.yaml:4:7: seed: value 'x'"),
                                            StartsWith("--set radar.pulses: value '['"),
                                            StartsWith("--set view.elevation_deg: value '95'"),
                                            StartsWith("--set a..b: must be key.path=value")));
}

TEST(AllErrors, OfDistributionsAreOnePerKey) {
  EXPECT_THAT(errors_of(kShort + "view: {elevation_deg: uniform(-100 100), azimuth_deg: uniform(0 400)}\n"
                                 "sea: {peak_period_s: same(sea.gamma), gamma: uniform(3 2)}\n"
                                 "map: {range_span_m: uniform(100 200)}\n"),
              ElementsAre(HasSubstr("sea.gamma: value 'uniform(3 2)'"),
                          HasSubstr("map.range_span_m: value 'uniform(100 200)': must be one value for all maps")));
  EXPECT_THAT(errors_of(kShort + "view: {elevation_deg: uniform(-100 100), azimuth_deg: uniform(0 400)}\n"),
              ElementsAre(AllOf(HasSubstr("view.elevation_deg"), HasSubstr("drawn by uniform(-100, 100), is -100")),
                          AllOf(HasSubstr("view.azimuth_deg"), HasSubstr("drawn by uniform(0, 400), is 400"))));
}

TEST(AllErrors, AreAtMostTwentyAndACountOfTheOthers) {
  std::string yaml = kShort + "map:\n";
  for (int i = 0; i < 1000; ++i) yaml += fmt::format("  unknown_{}: 1\n", i);
  const std::vector<std::string> errors = errors_of(yaml + "dataset: {maps_per_shard: 0}\n");
  ASSERT_EQ(errors.size(), ErrorList::kMost + 1);
  EXPECT_EQ(errors.back(), "folder/file.yaml: and 981 more");
}

TEST(AllErrors, OfAMaterialAreReportedToo) {
  try {
    parse_material("material: m\nkind: pecc\nlowest_ghz: -1\n", "m.yaml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(messages_of(error), ElementsAre(StartsWith("m.yaml:1:1: source: this key is missing"),
                                                StartsWith("m.yaml:2:7: kind: value 'pecc'"),
                                                StartsWith("m.yaml:3:13: lowest_ghz: value '-1'")));
  }
}

TEST(AllErrors, OfAnotherVersionAreThatOfTheVersionAlone) {
  EXPECT_THAT(errors_of("seaglint: 2\nradars: 1\ntargets: {}\n"),
              ElementsAre(HasSubstr("seaglint: value '2': must be 1")));
}

// A file that is no YAML is one error.
TEST(AllErrors, AreNotThoseBehindInvalidYaml) { EXPECT_EQ(errors_of("seaglint: 1\nradar: [\nseed: x\n").size(), 1u); }

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// YAML text: what is read, refused and limited; modified and random texts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::HasSubstr;

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
  EXPECT_THAT(complaint_about(kShort + "radar: {<<: {pulse: 8}}"), HasSubstr("radar.pulse: unknown key"));
  EXPECT_THAT(complaint_about(kShort + "radar: {\"<<\": {pulses: 8}}"), HasSubstr("unknown key"));
}

TEST(ScenarioYaml, BooleansHaveTheSpellingsOfYaml) {
  for (const char* word : {"true", "True", "TRUE"})
    EXPECT_TRUE(parse(kShort + "sea_reflection: {enabled: " + word + "}").sea_reflection.enabled) << word;
  for (const char* word : {"false", "False", "FALSE"})
    EXPECT_FALSE(parse(kShort + "sea_reflection: {enabled: " + word + "}").sea_reflection.enabled) << word;
  for (const char* word : {"tRUE", "yes", "on", "1", "'true'"})
    EXPECT_THAT(complaint_about(kShort + "sea_reflection: {enabled: " + word + "}"),
                HasSubstr("must be true or false"));
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
    EXPECT_THAT(error.what(), HasSubstr("nbsp_indent.yaml:3:1: "));
    EXPECT_THAT(error.what(), HasSubstr("unknown key: it has U+00A0, a no-break space; keys are indented by blanks"));
  }
  EXPECT_THAT(complaint_about(kShort + "radar: {pulses: 64\xc2\xa0}"), HasSubstr("; it has U+00A0, a no-break space"));
  EXPECT_THAT(complaint_about(kShort + "view: {elevation_deg: \xe2\x88\x92"
                                       "2}"),
              HasSubstr("; it has U+2212, a minus sign"));
  EXPECT_THAT(complaint_about(kShort + "sea:\n  order: 1\n \xc2\xa0"
                                       "components: 3\n"),
              HasSubstr("U+00A0"));
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
    const std::size_t at = position();
    const std::size_t length = std::min<std::size_t>(random.below(20), text.size() - at);
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
  int read = 0;
  int refused = 0;
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

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Constructs of YAML and encodings in scenarios.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace seaglint

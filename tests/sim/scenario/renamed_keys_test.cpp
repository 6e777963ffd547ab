// SPDX-License-Identifier: BSD-3-Clause
// Every key and value of earlier versions is refused with its new name.
#include "sim/scenario/renamed_keys.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario/files/scenario_document.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A path of the table in the shortest scenario, whose only target is a.
std::string path_in_scenario(std::string_view pattern) {
  std::string path(pattern);
  if (const std::size_t star = path.find('*'); star != std::string::npos) path[star] = 'a';
  return path;
}

// The same path with another last name.
std::string with_last(const std::string& path, std::string_view name) {
  return path.substr(0, path.rfind('.') + 1) + std::string(name);
}

// A scenario of two lines, the second of which ends with the value of the path.
std::string scenario_with(const std::string& path, const std::string& value) {
  const std::vector<std::string> keys = split_path(path);
  const bool of_target = keys[0] == "targets";
  std::string text = fmt::format("seaglint: 1\n{}: {{", keys[0]), closing;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const bool last = i + 1 == keys.size();
    text += fmt::format("{}: {}", keys[i], last ? value : of_target && i == 1 ? "{label: 1, mesh: a.glb, " : "{");
    closing += '}';
  }
  return text + closing + (of_target ? "\n" : "\ntargets: {a: {label: 1, mesh: a.glb}}\n");
}

TEST(RenamedKeys, AreRefusedByTheirNewNames) {
  for (const RenamedKey& key : renamed_keys()) {
    const std::string path = path_in_scenario(key.path), renamed = fmt::format("renamed to {}{}", key.now, key.note);
    const std::string converted =
        key.convert != nullptr ? fmt::format(": write {}: {:g}", key.now, key.convert(0.07)) : "";
    EXPECT_EQ(complaint_about(kShort, {{path, "0.07"}}), fmt::format("--set {}: {}{}", path, renamed, converted));
    EXPECT_THAT(
        complaint_about(scenario_with(path, "0.07")),
        AllOf(StartsWith("folder/file.yaml:2:"), EndsWith(fmt::format(": {}: {}{}", path, renamed, converted))));
    // A value that is not a number is reported without a value to write.
    EXPECT_EQ(complaint_about(kShort, {{path, "x"}}), fmt::format("--set {}: {}", path, renamed));
    EXPECT_THAT(complaint_about(kShort, {{with_last(path, key.now), "0.07"}}),
                Not(testing::AnyOf(HasSubstr("unknown key"), HasSubstr("renamed"))));
  }
}

TEST(RenamedKeys, WithAnotherSignReportTheConvertedValue) {
  EXPECT_EQ(complaint_about("seaglint: 1\ntargets: {a: {label: 1, mesh: a.glb}}\nclutter:\n"
                            "  noise_to_clutter_db: 0\n"),
            "folder/file.yaml:4:3: clutter.noise_to_clutter_db: renamed to cnr_db, which has the opposite sign: write "
            "cnr_db: 0");
  EXPECT_THAT(complaint_about(kShort, {{"clutter.noise_to_clutter_db", "-30"}}),
              EndsWith("renamed to cnr_db, which has the opposite sign: write cnr_db: 30"));
}

// An override below a section of an old name is refused with the section's new name.
TEST(RenamedKeys, OfASectionAreNamedBelowItToo) {
  EXPECT_EQ(complaint_about(kShort, {{"radar.budget.losses_db", "3"}}),
            "--set radar.budget.losses_db: radar.budget: renamed to link_budget");
  EXPECT_EQ(complaint_about(kShort, {{"targets.a.with.0.target", "b"}}),
            "--set targets.a.with.0.target: targets.a.with: renamed to companions");
}

TEST(RenamedKeys, AreThoseOfTheirOwnSectionOnly) {
  EXPECT_THAT(complaint_about(kShort, {{"radar.with", "1"}}), HasSubstr("unknown key"));
  EXPECT_THAT(complaint_about(kShort, {{"clutter.budget", "1"}}), HasSubstr("unknown key"));
}

TEST(RenamedValues, AreRefusedByTheirNewNames) {
  for (const RenamedValue& old : renamed_values()) {
    const std::string path(old.path), value(old.value), now(old.now);
    EXPECT_EQ(complaint_about(kShort, {{path, value}}),
              fmt::format("--set {}: value '{}': renamed to '{}'", path, value, now));
    EXPECT_THAT(complaint_about(scenario_with(path, value)),
                AllOf(StartsWith("folder/file.yaml:2:"),
                      EndsWith(fmt::format(": {}: value '{}': renamed to '{}'", path, value, now))));
    EXPECT_THAT(complaint_about(kShort, {{path, now}}),
                Not(testing::AnyOf(HasSubstr("must be one of"), HasSubstr("a list"), HasSubstr("renamed"))));
  }
}

}  // namespace
}  // namespace seaglint

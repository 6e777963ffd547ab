// SPDX-License-Identifier: BSD-3-Clause
// learning.split: columns, which may have dots, with one value or several.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario/scenario.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using testing::ElementsAre;
using testing::StartsWith;

TEST(LearningSplit, HasAValueOrSeveralOfEachColumn) {
  const SplitSpec split =
      parse(kShort +
            "learning:\n  split:\n    by: data_set\n    hold_out: {sea.peak_period_s: 8:9, target_name: [ring, '4']}\n")
          .learning.split;
  EXPECT_EQ(split.by, "data_set");
  ASSERT_EQ(split.hold_out.size(), 2u);
  EXPECT_EQ(split.hold_out[0].column, "sea.peak_period_s");
  EXPECT_THAT(split.hold_out[0].values, ElementsAre("8:9"));
  EXPECT_EQ(split.hold_out[1].column, "target_name");
  EXPECT_THAT(split.hold_out[1].values, ElementsAre("ring", "4"));
}

TEST(LearningSplit, IsReplacedByOverrides) {
  const std::string text = kShort + "learning: {split: {hold_out: {gamma: 2}}}\n";
  EXPECT_TRUE(parse(text, {{"learning.split.hold_out", "{}"}}).learning.split.hold_out.empty());
  const SplitSpec split = parse(text, {{"learning.split.hold_out.gamma", "[3, 4]"}}).learning.split;
  ASSERT_EQ(split.hold_out.size(), 1u);
  EXPECT_THAT(split.hold_out[0].values, ElementsAre("3", "4"));
}

TEST(LearningSplit, IsRefusedWithItsPlace) {
  const auto complaint = [](const std::string& split) { return complaint_about(kShort + "learning: " + split + "\n"); };
  EXPECT_THAT(complaint("{split: sea}"),
              StartsWith("folder/file.yaml:4:19: learning.split: value 'sea': must be a map"));
  EXPECT_EQ(complaint("{split: {hold_out: [a]}}"),
            "folder/file.yaml:4:30: learning.split.hold_out: a list: must be a map of at most 100 columns with their "
            "values");
  EXPECT_EQ(complaint("{split: {hold_out: {gamma: []}}}"),
            "folder/file.yaml:4:38: learning.split.hold_out.gamma: a list: must be a value or a list of 1 to 1000 "
            "values");
  EXPECT_EQ(complaint("{split: {hold_out: {gamma: [1, {}]}}}"),
            "folder/file.yaml:4:42: learning.split.hold_out.gamma: a map: must be a text of 1 to 4096 printable "
            "characters");
  EXPECT_THAT(complaint("{split: {hold_out: {gamma: 1, gamma: 2}}}"),
              StartsWith("folder/file.yaml:4:41: learning.split.hold_out.gamma: this key appears twice"));
  EXPECT_THAT(complaint("{split: {hold_out: {gamma: 'uniform(1, 2)'}}}"),
              StartsWith("folder/file.yaml:4:38: learning.split.hold_out.gamma: value 'uniform(1, 2)': must be one "
                         "value for all maps"));
}

}  // namespace
}  // namespace seaglint

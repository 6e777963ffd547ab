// SPDX-License-Identifier: BSD-3-Clause
// Names of the classes of a scenario, and labels that are none of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"
#include "sim/scenario/writer.h"
#include "tests/sim/scenario/parsing.h"

namespace seaglint {
namespace {

using namespace testing_scenarios;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(ScenarioClasses, AreDifferentNamesAndEveryLabelIsOneOfThem) {
  const auto classes = [](const std::string& list) {
    return kShort + std::string("dataset: {classes: ") + list + "}\n";
  };
  EXPECT_EQ(parse_scenario(kShort, "file.yaml").dataset.classes, (std::vector<std::string>{"array", "ship"}));
  const Scenario three = parse_scenario(classes("[decoys, ship, guarded ship]"), "file.yaml");
  EXPECT_EQ(three.dataset.classes, (std::vector<std::string>{"decoys", "ship", "guarded ship"}));
  EXPECT_THAT(effective_yaml(three), HasSubstr("\n  classes: [decoys, ship, \"guarded ship\"]\n"));
  EXPECT_THAT(effective_yaml(parse_scenario(classes("[array, ship]"), "file.yaml")), Not(HasSubstr("classes")));

  const std::string first = "folder/file.yaml:4:20: dataset.classes: ", item = "folder/file.yaml:4:";
  EXPECT_EQ(complaint_about(classes("[ship]")), first + "a list: must be a list of 2 to 10 names");
  EXPECT_EQ(complaint_about(classes("[a, b, c, d, e, f, g, h, i, j, k]")),
            first + "a list: must be a list of 2 to 10 names");
  EXPECT_EQ(complaint_about(classes("ship")), first + "value 'ship': must be a list of 2 to 10 names");
  EXPECT_EQ(complaint_about(classes("[my ship, my_ship]")),
            item + "30: dataset.classes.1: value 'my_ship': must differ from the others, also with '_' for a space");
  EXPECT_EQ(complaint_about(classes("[a, 'b,c']")),
            item + "24: dataset.classes.1: value 'b,c': must be 1 to 40 letters, digits, '_', '-' or spaces within");
  EXPECT_EQ(complaint_about(classes("[a, b, c]"), {{"targets.a.label", "3"}}),
            "--set targets.a.label: value '3': must be within 0 and 2, a class of dataset.classes: a, b, c");
  EXPECT_EQ(complaint_about(kShort, {{"targets.a.label", "2"}}),
            "--set targets.a.label: value '2': must be 0 or 1, a class of dataset.classes: array, ship");
  EXPECT_EQ(complaint_about(kShort, {{"targets.a.label", "10"}}),
            "--set targets.a.label: value '10': must be a whole number within 0 and 9");
}

}  // namespace
}  // namespace seaglint

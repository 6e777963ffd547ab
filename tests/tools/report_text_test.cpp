// SPDX-License-Identifier: BSD-3-Clause
// What the report says of probes that know nothing.
#include "tools/report_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace seaglint {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

// Scores of 300 rows: right about so many of the ships and of the arrays.
ordered_json scores(double ships, double ships_right, double arrays_right) {
  const double arrays = 300 - ships;
  return {{"rows", 300},
          {"accuracy", (ships_right + arrays_right) / 300},
          {"accuracy_95", {nullptr, nullptr}},
          {"confusion",
           {{"array_as_array", arrays_right},
            {"array_as_ship", arrays - arrays_right},
            {"ship_as_array", ships - ships_right},
            {"ship_as_ship", ships_right}}}};
}

std::string table_of(const ordered_json& scores) {
  return probes_table({{"split_repeats", 1},
                       {"probes", {{{"name", "hop code"}, {"kind", "blind"}, {"meaning", "-"}, {"random", scores}, {"group", scores}}}}});
}

TEST(ProbesTable, CallsTheSharesOfTheClassesChance) {
  // As many ships as arrays: half is chance, give or take 2.576 standard deviations, 7.4 points.
  EXPECT_THAT(table_of(scores(150, 80, 75)), HasSubstr("as chance"));
  EXPECT_THAT(table_of(scores(150, 90, 90)), HasSubstr("look for a leak"));
  EXPECT_THAT(table_of(scores(150, 60, 60)), HasSubstr("look for a leak"));
  // Two ships to an array: naming ships always is right in 66.7 %, guessing at the shares in 55.6 %.
  EXPECT_THAT(table_of(scores(200, 200, 0)), Not(HasSubstr("leak")));
  EXPECT_THAT(table_of(scores(200, 133, 33)), Not(HasSubstr("leak")));
  EXPECT_THAT(table_of(scores(200, 180, 50)), HasSubstr("look for a leak"));
  EXPECT_THAT(table_of(scores(200, 100, 20)), HasSubstr("look for a leak"));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/number.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

using ::testing::ElementsAre;

std::string complaint_about(const std::string& range) {
  try {
    parse_range(range);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Number, IsReadCompletelyOrNotAtAll) {
  EXPECT_EQ(parse_number("16"), 16.0);
  EXPECT_EQ(parse_number("-0.5"), -0.5);
  EXPECT_EQ(parse_number("+2.5e3"), 2500.0);
  EXPECT_EQ(parse_number("1e-300"), 1e-300);
  for (const char* text : {"", " ", "+", "-", "+-1", "++1", "1 ", " 1", "1x", "0x10", "1e999", "inf", "-inf", "nan",
                           ".nan", "1,5", "1_000"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(Range, IncludesBothEnds) {
  EXPECT_THAT(parse_range("10:170:40"), ElementsAre(10, 50, 90, 130, 170));
  EXPECT_THAT(parse_range("5"), ElementsAre(5));
  EXPECT_THAT(parse_range("3:3:1"), ElementsAre(3));
  EXPECT_THAT(parse_range("2:-2:-2"), ElementsAre(2, 0, -2));
  EXPECT_THAT(parse_range("10:15:2"), ElementsAre(10, 12, 14));
}

TEST(Range, EndsExactlyAtItsEnd) {
  // Sums of 0.1 differ from 0.3, 0.7 and 1 by rounding; the end must neither be lost nor be doubled.
  for (int last = 1; last <= 1000; ++last) {
    const std::string end = std::to_string(last / 10) + "." + std::to_string(last % 10);
    const std::vector<double> values = parse_range("0:" + end + ":0.1");
    ASSERT_EQ(values.size(), static_cast<std::size_t>(last) + 1) << end;
    EXPECT_EQ(values.back(), std::stod(end));
  }
}

TEST(Range, ReportsErrors) {
  EXPECT_EQ(complaint_about("1:2"), "value '1:2': must be a number or from:to:step");
  EXPECT_EQ(complaint_about("1:2:3:4"), "value '1:2:3:4': must be a number or from:to:step");
  EXPECT_EQ(complaint_about("a:2:1"), "value 'a:2:1': must be a number or from:to:step");
  EXPECT_EQ(complaint_about(""), "value '': must be a number or from:to:step");
  EXPECT_EQ(complaint_about("::"), "value '::': must be a number or from:to:step");
  EXPECT_EQ(complaint_about("1:2:0"), "value '1:2:0': must be from:to:step with a step other than 0");
  EXPECT_EQ(complaint_about("1:2:-1"),
            "value '1:2:-1': must be from:to:step with a step that leads from the first value to the second");
  EXPECT_EQ(complaint_about("0:1:1e-9"), "value '0:1:1e-9': must be a range of at most 1000000 values");
  EXPECT_EQ(complaint_about("-1e308:1e308:1e-308"),
            "value '-1e308:1e308:1e-308': must be a range of at most 1000000 values");
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/words.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "tests/refusal.h"

namespace seaglint {
namespace {

using ::testing::ElementsAre;

std::string complaint_about(const std::string& range) {
  return refusal_of([&] { parse_range(range); });
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

TEST(Number, OfFormatsThatDefineThemMayBeInfinityOrNan) {
  EXPECT_EQ(parse_any_number("-1.5"), -1.5);
  EXPECT_EQ(parse_any_number("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(parse_any_number("NaN").value()));
  for (const char* text : {"", "+-1", "inf1", "nanx", "0x1p3", "0x1p3zzz"}) {
    EXPECT_FALSE(parse_any_number(text)) << text;
  }
}

TEST(Number, OfAnIntegerHasDigitsOnly) {
  EXPECT_EQ(parse_integer("-12"), -12);
  EXPECT_EQ(parse_integer("+3"), 3);
  EXPECT_EQ(parse_natural("18446744073709551615"), 18446744073709551615ull);
  for (const char* text : {"", "+", "+-1", "--1", "1/xyz", "0.5", "1.0", "1e3", "0x1p3zzz", "9223372036854775808"}) {
    EXPECT_FALSE(parse_integer(text)) << text;
  }
  EXPECT_FALSE(parse_natural("-1"));
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

// Values are the doubles of their decimal digits, as `azimuth_deg == 0.3` compares them; sums of doubles give
// 0.30000000000000004.
TEST(Range, HasTheValuesOfItsDecimals) {
  for (const auto& [text, decimals] : {std::pair{"0.1:1.5:0.1", 1},
                                       {"0:0.5:0.1", 1},
                                       {"-2:2:0.05", 2},
                                       {"9.3:9.5:0.001", 3},
                                       {"1e-3:9e-3:1e-3", 3},
                                       {"170:-170:-0.7", 1},
                                       {"0.001:1:1e-6", 6},
                                       {"5:6:.01", 2}}) {
    for (const double value : parse_range(text)) {
      EXPECT_EQ(value, std::stod(fmt::format("{:.{}f}", value, decimals))) << text;
    }
  }
  EXPECT_THAT(parse_range("0:4e20:2e20"), ElementsAre(0, 2e20, 4e20));
  // Digits beyond those of a double are summed as doubles.
  EXPECT_THAT(parse_range("0.12345678901234567:1:0.5"), ElementsAre(0.12345678901234567, 0.62345678901234567));
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

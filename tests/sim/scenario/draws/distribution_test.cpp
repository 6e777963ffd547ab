// SPDX-License-Identifier: BSD-3-Clause
// Distributions of drawn values against their closed moments, their ends and their texts.
#include "sim/scenario/draws/distribution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/core/process/error.h"
#include "sim/core/text/words.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

constexpr int kDraws = 40000;

std::vector<std::string> draws_of(const std::string& text) {
  const Distribution distribution = parse_distribution(text).value();
  std::vector<std::string> values;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    Random random({7, Stream::kTest, i});
    values.push_back(distribution.draw(random));
  }
  return values;
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& value : draws_of(text)) numbers.push_back(parse_number(value).value());
  return numbers;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// Mean and deviation within five standard errors; those of a deviation are at most its own over sqrt(2 n), which holds
// for tails up to the normal one.
void expect_moments(const std::string& text, double expected_mean, double expected_deviation) {
  const std::vector<double> values = numbers_of(text);
  EXPECT_NEAR(mean(values), expected_mean, 5 * expected_deviation / std::sqrt(kDraws)) << text;
  EXPECT_NEAR(deviation(values), expected_deviation, 5 * expected_deviation / std::sqrt(2.0 * kDraws)) << text;
}

TEST(Distribution, HasTheMomentsOfItsDefinition) {
  expect_moments("uniform(5, 9)", 7, 4 / std::sqrt(12.0));
  expect_moments("uniform(-1.5,-0.5)", -1, 1 / std::sqrt(12.0));
  expect_moments("normal(10, 2)", 10, 2);
  expect_moments("integers(3, 30)", 16.5, std::sqrt((28.0 * 28 - 1) / 12));
  // (b - a) / L and the second moment (b^2 - a^2) / (2 L) with L = ln(b / a).
  const double length = std::log(20.0), average = 1.9 / length, square = (4 - 0.01) / (2 * length);
  expect_moments("loguniform(0.1, 2)", average, std::sqrt(square - average * average));
  // Truncated at one deviation on both sides: 1 - 2 phi(1) / (2 Phi(1) - 1).
  expect_moments("normal(0, 1, -1, 1)", 0, std::sqrt(1 - 2 * 0.24197072451914337 / 0.6826894921370859));
}

TEST(Distribution, OfChoicesDrawsEachEquallyOften) {
  std::map<std::string, int> counts;
  for (const std::string& value : draws_of("choice(random, costas, linear, 4.5)")) ++counts[value];
  ASSERT_EQ(counts.size(), 4u);
  const double error = std::sqrt(kDraws * 0.25 * 0.75);
  for (const auto& [value, count] : counts) EXPECT_NEAR(count, kDraws / 4.0, 5 * error) << value;
}

TEST(Distribution, DrawsStayWithinItsEnds) {
  for (const char* text : {"uniform(5, 9)", "loguniform(0.1, 2)", "normal(3, 1)", "normal(0, 5, 1, 2)",
                           "integers(1, 3)", "uniform(0.1, 0.30000000000000004)"}) {
    const std::vector<std::string> ends = parse_distribution(text)->ends();
    const double low = parse_number(ends[0]).value(), high = parse_number(ends[1]).value();
    const std::vector<double> values = numbers_of(text);
    EXPECT_GE(std::ranges::min(values), low) << text;
    EXPECT_LE(std::ranges::max(values), high) << text;
    const double middle = parse_number(parse_distribution(text)->middle()).value();
    EXPECT_TRUE(low <= middle && middle <= high) << text;
  }
  const std::vector<double> whole = numbers_of("integers(1, 3)");
  for (const double end : {1.0, 2.0, 3.0}) EXPECT_GT(std::ranges::count(whole, end), kDraws / 4) << end;
}

TEST(Distribution, IsWrittenAsItWasRead) {
  for (const char* text : {"uniform(5, 9)", "normal(3, 1, 2, 4)", "choice(a, b-c, 4)", "loguniform(1e-3, 1e3)"}) {
    const Distribution read = parse_distribution(text).value();
    EXPECT_EQ(read.text(), text);
    EXPECT_EQ(parse_distribution(read.text())->values, read.values);
  }
  EXPECT_EQ(parse_distribution("uniform(5 9)")->text(), "uniform(5, 9)");
  EXPECT_EQ(parse_distribution("uniform( 5 ,9 )")->text(), "uniform(5, 9)");
}

TEST(Distribution, OfOtherTextsIsNone) {
  for (const char* text : {"", "5", "uniform", "Uniform(1, 2)", "ship (old)", "(1, 2)", "5:9:1", "uniform [1, 2]"})
    EXPECT_FALSE(parse_distribution(text)) << text;
}

TEST(Distribution, WithoutMassIsRefusedWithItsForm) {
  const std::map<std::string, std::string> wrong = {
      {"uniform(9, 5)", "a < b"},
      {"uniform(5, 5)", "a < b"},
      {"uniform(5)", "a < b"},
      {"uniform(5, 9", "in quotes or with blanks for commas"},
      {"uniform(5, nan)", "a < b"},
      {"uniform(1e999, 2)", "a < b"},
      {"loguniform(0, 2)", "0 < a < b"},
      {"loguniform(-1, 2)", "0 < a < b"},
      {"normal(1, 0)", "std > 0"},
      {"normal(1, 1, 3, 2)", "low < high"},
      {"normal(0, 1, 10, 11)", "at least 1 %"},
      {"integers(1.5, 3)", "whole numbers"},
      {"integers(0, 9999999999)", "whole numbers"},
      {"choice(a)", "2 to 1000 different"},
      {"choice(a, a)", "2 to 1000 different"},
      {"choice()", "2 to 1000 different"},
      {"choice(a, " + std::string(65, 'b') + ")", "at most 64 bytes"},
  };
  for (const auto& [text, reason] : wrong) {
    try {
      parse_distribution(text);
      ADD_FAILURE() << text << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(reason)) << text;
    }
  }
}

}  // namespace
}  // namespace seaglint

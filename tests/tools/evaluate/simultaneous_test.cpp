// SPDX-License-Identifier: BSD-3-Clause
// Holm's procedure on its definition, and its family-wise error over many sets of chance accuracies.
#include "tools/evaluate/claims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

TEST(HolmIntervals, OfOneEstimateAreThoseOfTheNormalDistribution) {
  const Estimate one{0.55, 0.02};
  const ConfidenceInterval interval = holm_intervals(std::span(&one, 1))[0];
  EXPECT_NEAR(interval.low, 0.55 - 1.959963984540054 * 0.02, 1e-12);
  EXPECT_NEAR(interval.high, 0.55 + 1.959963984540054 * 0.02, 1e-12);
}

// Tables of Student's distribution, 97.5 %: 2.571, 2.262 and 2.045 for 5, 9 and 29 degrees of freedom.
TEST(HolmIntervals, OfFewSeasAreThoseOfStudentsDistribution) {
  for (const auto& [degrees, t] : {std::pair{5.0, 2.571}, {9.0, 2.262}, {29.0, 2.045}}) {
    const Estimate one{0.5, 0.02, degrees};
    EXPECT_NEAR(holm_intervals(std::span(&one, 1))[0].high, 0.5 + t * 0.02, 3e-5) << degrees;
  }
}

// Tables of Student's distribution (Abramowitz and Stegun 1964, table 26.10; two-sided 5 % and 0.5 %, and 0.1 %).
TEST(StudentQuantile, IsThatOfTheTables) {
  struct Row {
    double degrees, at_975, at_9975, at_9995;
  };
  for (const Row& row : {Row{1, 12.706, 127.321, 636.619}, Row{2, 4.303, 14.089, 31.599}, Row{3, 3.182, 7.453, 12.924},
                         Row{4, 2.776, 5.598, 8.610}, Row{5, 2.571, 4.773, 6.869}, Row{9, 2.262, 3.690, 4.781},
                         Row{20, 2.086, 3.153, 3.850}, Row{29, 2.045, 3.038, 3.659}, Row{60, 2.000, 2.915, 3.460},
                         Row{120, 1.980, 2.860, 3.373}}) {
    EXPECT_NEAR(student_quantile(0.975, row.degrees), row.at_975, 6e-4) << row.degrees;
    EXPECT_NEAR(student_quantile(0.9975, row.degrees), row.at_9975, 6e-4) << row.degrees;
    EXPECT_NEAR(student_quantile(0.9995, row.degrees), row.at_9995, 6e-4) << row.degrees;
  }
  constexpr double kNormal = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(student_quantile(0.975, kNormal), 1.959963984540054, 1e-12);
  EXPECT_EQ(student_quantile(0.975, 9.99), student_quantile(0.975, 9));
  // Both formulas at their border: the difference of one degree of freedom.
  EXPECT_NEAR(student_quantile(0.9995, 299) / student_quantile(0.9995, 300), 1 + 3.29 * 3.29 / (4 * 299 * 300), 1e-5);
}

// Welch's example of equal errors has twice the degrees of freedom; one error alone has its own.
TEST(DifferenceOfEstimates, HasTheDegreesOfFreedomOfWelch) {
  const Estimate equal = difference_of({0.8, 0.03, 9}, {0.7, 0.03, 9});
  EXPECT_NEAR(equal.value, 0.1, 1e-15);
  EXPECT_NEAR(equal.standard_error, 0.03 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(equal.degrees_of_freedom, 18, 1e-9);
  const Estimate alone = difference_of({0.8, 0.03, 9}, {1, 0, 29});
  EXPECT_NEAR(alone.degrees_of_freedom, 9, 1e-9);
  EXPECT_NEAR(half_width(alone), 2.262 * 0.03, 3e-5);
  EXPECT_EQ(half_width(difference_of({1, 0, 9}, {0.9, 0, 9})), 0);
  EXPECT_TRUE(std::isnan(half_width(difference_of({1, std::nan(""), 9}, {0.9, 0.1, 9}))));
}

// Means of 10 seas that are each right or wrong by chance, with the standard error of these 10: 5 % of sets of 11 such
// quantities have one that differs from chance. With the normal quantiles it would be 19 %.
TEST(HolmRejections, ErrInAtMostFivePercentOfSetsOfFewSeas) {
  constexpr int kSets = 4000, kSeas = 10;
  int wrong = 0;
  for (std::uint64_t i = 0; i < kSets; ++i) {
    Random random({12, Stream::kTest, i});
    std::vector<Estimate> estimates(11);
    for (Estimate& estimate : estimates) {
      double sum = 0, squares = 0;
      for (int sea = 0; sea < kSeas; ++sea) {
        const double accuracy = 0.5 + 0.15 * random.normal();
        sum += accuracy;
        squares += accuracy * accuracy;
      }
      const double mean = sum / kSeas;
      estimate = {mean, std::sqrt((squares / kSeas - mean * mean) / (kSeas - 1)), kSeas - 1};
    }
    const std::vector<bool> rejected = holm_rejections(estimates);
    wrong += std::find(rejected.begin(), rejected.end(), true) != rejected.end() ? 1 : 0;
  }
  EXPECT_NEAR(wrong / static_cast<double>(kSets), 0.0489, 5 * std::sqrt(0.0489 * 0.9511 / kSets));
}

// z of 0.05/6, 0.05/4 and 0.05/2 two-sided: 2.3940, 2.2414, 1.9600.
TEST(HolmIntervals, HaveTheLevelsOfTheirRanks) {
  const std::vector<Estimate> estimates{{0.51, 0.01}, {0.60, 0.01}, {0.45, 0.01}};
  const std::vector<ConfidenceInterval> intervals = holm_intervals(estimates);
  const double expected[] = {1.95996, 2.39398, 2.24140};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR((intervals[i].high - intervals[i].low) / 0.02, expected[i], 1e-4) << i;
}

// 2.3 errors from the null: rejected as the second of two, not as the first of three.
TEST(HolmRejections, StopAtTheFirstThatIsNotRejected) {
  EXPECT_EQ(holm_rejections(std::vector<Estimate>{{0.523, 0.01}, {0.6, 0.01}}), (std::vector<bool>{true, true}));
  EXPECT_EQ(holm_rejections(std::vector<Estimate>{{0.523, 0.01}, {0.52, 0.01}, {0.5, 0.01}}),
            (std::vector<bool>{false, false, false}));
}

TEST(HolmRejections, ErrInFivePercentOfSetsOfChanceAccuracies) {
  constexpr int kSets = 4000;
  int wrong = 0;
  for (std::uint64_t i = 0; i < kSets; ++i) {
    Random random({11, Stream::kTest, i});
    std::vector<Estimate> estimates(20);
    for (Estimate& estimate : estimates) estimate = {0.5 + 0.03 * random.normal(), 0.03};
    const std::vector<bool> rejected = holm_rejections(estimates);
    wrong += std::find(rejected.begin(), rejected.end(), true) != rejected.end() ? 1 : 0;
  }
  // 1 - (1 - 0.05/20)^20 = 0.0488, five standard errors.
  EXPECT_NEAR(wrong / static_cast<double>(kSets), 0.0488, 5 * std::sqrt(0.0488 * 0.9512 / kSets));
}

TEST(HolmIntervals, OfAMissingEstimateAreMissingAndDoNotCount) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Estimate> estimates{{none, 0.1}, {0.55, 0.02}, {0.5, none}};
  EXPECT_TRUE(std::isnan(holm_intervals(estimates)[0].low));
  EXPECT_NEAR(holm_intervals(estimates)[1].low, 0.55 - 1.959963984540054 * 0.02, 1e-12);
  EXPECT_EQ(holm_rejections(estimates), (std::vector<bool>{false, true, false}));
}

}  // namespace
}  // namespace seaglint

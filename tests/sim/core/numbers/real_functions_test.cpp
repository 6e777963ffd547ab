// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/real_functions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace seaglint {
namespace {

TEST(Quantile, InterpolatesBetweenRanks) {
  const std::vector<double> values{1, 2, 4, 8};
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile(values, 1), 8);
  EXPECT_EQ(quantile(values, 0.5), 3);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 4 + 0.7 * 4);
  EXPECT_EQ(quantile(std::vector<double>{5}, 0.3), 5);
}

TEST(Quantile, QuartilesAreThoseOfTheFiniteValues) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const Quartiles q = quartiles({5, nan, 1, 3, infinity, 2, 4});
  EXPECT_EQ(q.lower, 2);
  EXPECT_EQ(q.median, 3);
  EXPECT_EQ(q.upper, 4);
  EXPECT_TRUE(std::isnan(quartiles({nan}).median));
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(SmoothStep, FallsFromOneToZeroWithoutAKink) {
  const std::array<double, 2> from_to{2, 5};
  EXPECT_EQ(smooth_taper(1, from_to), 1);
  EXPECT_EQ(smooth_taper(2, from_to), 1);
  EXPECT_EQ(smooth_taper(3.5, from_to), 0.5);
  EXPECT_EQ(smooth_taper(5, from_to), 0);
  EXPECT_EQ(smooth_taper(7, from_to), 0);
  // Its slope at either end is zero: there it differs by 3 (x / 3)^2.
  EXPECT_NEAR(1 - smooth_taper(2 + 3e-4, from_to), 3e-8, 1e-11);
  EXPECT_NEAR(smooth_taper(5 - 3e-4, from_to), 3e-8, 1e-11);
}

TEST(SmoothStep, InterpolatesFromTheFirstEnd) {
  EXPECT_EQ(interpolate<double>({4, 8}, 0), 4);
  EXPECT_EQ(interpolate<double>({4, 8}, 0.25), 5);
  EXPECT_EQ(interpolate<double>({4, 8}, 1), 8);
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/quantile.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/reproducible_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace seaglint {
namespace {

TEST(ReproducibleFunctions, AreLogarithmExponentialAndTangent) {
  for (double x = 1e-300; x < 1e300; x *= 1.7) {
    EXPECT_NEAR(reproducible_log(x), std::log(x), 4e-16 * std::abs(std::log(x)) + 2e-16) << x;
  }
  for (double x = -699.9; x < 699; x += 0.377) EXPECT_NEAR(reproducible_exp(x) / std::exp(x), 1, 4.5e-16) << x;
  EXPECT_EQ(reproducible_exp(0), 1);
  EXPECT_EQ(reproducible_exp(-1000), 0);
  for (double x = 1e-12; x < 1000; x *= 1.03) {
    EXPECT_NEAR(reproducible_tanh(x) / std::tanh(x), 1, 1e-15) << x;
    EXPECT_EQ(reproducible_tanh(-x), -reproducible_tanh(x));
  }
  EXPECT_EQ(reproducible_tanh(0), 0);
}

TEST(UnitPhasors, AreCosinesAndSines) {
  std::vector<double> angle;
  for (int i = -2000; i <= 2000; ++i) angle.push_back(0.7853981633974483 * i + 1e-3 * (i % 7));
  for (double a = 1e-300; a < kLargestAngle; a *= 1.9) angle.insert(angle.end(), {a, -a});
  std::vector<double> cosine(angle.size()), sine(angle.size());
  unit_phasors(angle, cosine, sine);
  for (std::size_t i = 0; i < angle.size(); ++i) {
    EXPECT_NEAR(cosine[i], std::cos(angle[i]), 4e-16) << angle[i];
    EXPECT_NEAR(sine[i], std::sin(angle[i]), 4e-16) << angle[i];
  }
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/reproducible_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace seaglint {
namespace {

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

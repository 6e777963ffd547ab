// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/fourier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// A sine of amplitude a has the variance a^2 / 2, at any frequency between two lines.
TEST(Periodogram, HoldsTheVarianceOfASine) {
  constexpr double kStep = 0.1, kAmplitude = 3, kOmega = 2.345;
  constexpr std::size_t kSamples = 1000;
  std::vector<double> sine;
  for (std::size_t n = 0; n < kSamples; ++n)
    sine.push_back(kAmplitude * std::sin(kOmega * kStep * static_cast<double>(n) + 0.7));
  for (const std::size_t padding : {1u, 2u}) {
    const auto density = periodograms(std::vector{sine, std::vector<double>(kSamples, 0.0)}, kStep, 300, padding);
    const double resolution = 2 * kPi / (static_cast<double>(padding * kSamples) * kStep);
    ASSERT_EQ(density[0].size(), 300u);
    EXPECT_NEAR(std::accumulate(density[0].begin(), density[0].end(), 0.0) * resolution, kAmplitude * kAmplitude / 2,
                1e-3);
    const auto peak = std::max_element(density[0].begin(), density[0].end()) - density[0].begin();
    EXPECT_NEAR(static_cast<double>(peak + 1) * resolution, kOmega, 0.51 * resolution);
    EXPECT_EQ(density[1], std::vector<double>(300, 0.0));
  }
}

}  // namespace
}  // namespace seaglint

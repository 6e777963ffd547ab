// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/fourier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

constexpr std::size_t kLength = 45, kRows = 3;

std::vector<Complex> random_numbers(std::size_t count) {
  Random random({3, Stream::kTest, 0});
  std::vector<Complex> values;
  for (std::size_t i = 0; i < count; ++i) values.emplace_back(random.uniform() - 0.5, random.uniform() - 0.5);
  return values;
}

// The definition, summed term by term.
Complex term_sum(const Complex* row, std::size_t k, double sign) {
  Complex sum;
  for (std::size_t i = 0; i < kLength; ++i) {
    const auto turns = static_cast<double>(i * k % kLength) / static_cast<double>(kLength);
    sum += row[i] * std::polar(1.0, sign * 2 * kPi * turns);
  }
  return sum;
}

TEST(FourierBatch, IsTheSumOfItsDefinition) {
  const std::vector<Complex> values = random_numbers(kLength * kRows);
  for (const Fourier direction : {Fourier::kForward, Fourier::kInverse}) {
    FourierBatch batch(kLength, kRows, direction);
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(batch.row(i / kLength)[i % kLength], Complex());
      batch.row(i / kLength)[i % kLength] = values[i];
    }
    batch.execute();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Complex expected =
          term_sum(&values[i / kLength * kLength], i % kLength, direction == Fourier::kForward ? -1 : 1);
      EXPECT_NEAR(std::abs(batch.row(i / kLength)[i % kLength] - expected), 0, 1e-13);
    }
  }
}

TEST(TransformRows, KeepsValuesBetweenTheRows) {
  constexpr std::size_t kStride = kLength + 6;
  const std::vector<Complex> before = random_numbers(kStride * kRows);
  std::vector<Complex> values = before;
  transform_rows(values.data(), kLength, kRows, kStride, Fourier::kInverse);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t place = i % kStride;
    const Complex expected = place < kLength ? term_sum(&before[i - place], place, 1) : before[i];
    EXPECT_NEAR(std::abs(values[i] - expected), 0, 1e-13) << i;
  }
}

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

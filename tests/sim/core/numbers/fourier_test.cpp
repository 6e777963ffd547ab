// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/fourier.h"

#include <gtest/gtest.h>

#include <cmath>
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

}  // namespace
}  // namespace seaglint

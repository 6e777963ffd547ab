// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/network_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "classify/features/feature_vector.h"
#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

constexpr std::size_t kPlane = kInputRows * kInputColumns;

CentreList random_centres(std::size_t count, std::uint64_t index) {
  Random random({3, Stream::kTest, index});
  CentreList centres;
  for (std::size_t i = 0; i < count; ++i)
    centres.push_back({30 * random.normal(), 0.2 * random.normal(), 0.1 + random.uniform()});
  return centres;
}

void expect_near(const std::vector<float>& a, const std::vector<float>& b, std::size_t begin, double bound) {
  for (std::size_t i = begin; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], bound) << "cell " << i;
}

TEST(NetworkInput, DoesNotDependOnLevelPlaceAndMeanVelocity) {
  const CentreList centres = random_centres(12, 1);
  CentreList other = centres;
  for (ScatteringCentre& centre : other) {
    centre.amplitude_m *= 1734;
    centre.range_m += 41.5;
    centre.velocity_mps -= 2.25;
  }
  // Rounding of a range of 100 m, 1e-14, times the steepest slope of the images, below 100 per metre or m/s.
  expect_near(network_input(other, -40), network_input(centres, -40), 0, 1e-6);
}

TEST(NetworkInput, HasAZoomThatDoesNotDependOnAConstantRotation) {
  const CentreList centres = random_centres(12, 2);
  CentreList other = centres;
  for (ScatteringCentre& centre : other) centre.velocity_mps += 0.004 * centre.range_m;
  const std::vector<float> a = network_input(centres, -40), b = network_input(other, -40);
  expect_near(a, b, kPlane, 1e-6);
  EXPECT_FALSE(std::equal(a.begin(), a.begin() + kPlane, b.begin()));
}

// Three equal centres: the mean range and velocity are those of the middle one, and 10 log10(3) = 4.77 dB is their
// level below the sum.
TEST(NetworkInput, HasTheCentresAtTheirPlaces) {
  const std::vector<float> input = network_input(CentreList{{-30, 0.5, 2}, {0, 0, 2}, {30, -0.5, 2}}, -40);
  const double height = 1 - 10 * std::log10(3) / 40;
  // Overview: column 0.5 (x + 1) 64 - 0.5, x = 30/96; row 0.5 (y + 1) 32 - 0.5, y = 0.5. Distances from the cell.
  const auto gauss = [&](double rows, double columns) {
    return height * std::exp(-0.5 * (rows * rows + columns * columns) / (0.8 * 0.8));
  };
  EXPECT_NEAR(input[8 * kInputColumns + 42], gauss(0.5, 0.5), 1e-6);   // place 7.5, 41.5
  EXPECT_NEAR(input[23 * kInputColumns + 22], gauss(0.5, 0.5), 1e-6);  // place 23.5, 21.5
  EXPECT_NEAR(input[16 * kInputColumns + 32], gauss(0.5, 0.5), 1e-6);  // place 15.5, 31.5
  EXPECT_EQ(input[0], 0);
  // Zoom: on a line, so all in the middle row.
  for (std::size_t row = 0; row < kInputRows; ++row) {
    const float* const begin = &input[kPlane + row * kInputColumns];
    const float highest = *std::max_element(begin, begin + kInputColumns);
    if (row == 15 || row == 16) {
      EXPECT_GT(highest, 0.5);
    }
    if (row < 12 || row > 19) {
      EXPECT_EQ(highest, 0);
    }
  }
}

TEST(NetworkInput, AcceptsAnyCentres) {
  EXPECT_EQ(network_input({}, -40), std::vector<float>(kInputCells, 0.0f));
  EXPECT_EQ(network_input(CentreList{{4, 1, 0}}, -40), std::vector<float>(kInputCells, 0.0f));
  for (const CentreList& centres : {CentreList{{4, 1, 1}}, CentreList{{4, 1, 1}, {4, 1, 1}},
                                    CentreList{{-1e6, 1e4, 1e-20}, {1e6, -1e4, 1e20}}, random_centres(1000, 3)}) {
    const std::vector<float> input = network_input(centres, -40);
    ASSERT_EQ(input.size(), kInputCells);
    for (const float value : input) {
      ASSERT_GE(value, 0.0f);
      ASSERT_LE(value, 1.0f);
    }
    EXPECT_GT(*std::max_element(input.begin(), input.end()), 0.0f);
  }
}

// What separates the classes is the residual from a line; a variation must not change its distribution.
TEST(Augmentation, KeepsTheResidualsFromTheLine) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random({5, Stream::kTest, i});
    const CentreList centres = random_centres(4, 100 + i), other = observed_otherwise(centres, random);
    ASSERT_EQ(other.size(), centres.size());
    const VelocityLine line = robust_velocity_line(centres), changed = robust_velocity_line(other);
    for (std::size_t k = 0; k < centres.size(); ++k) {
      EXPECT_NEAR(std::abs(changed.residual(other[k])), std::abs(line.residual(centres[k])), 1e-12);
      EXPECT_EQ(other[k].amplitude_m, centres[k].amplitude_m);
    }
  }
}

TEST(Augmentation, OfARigidLineLeavesItALine) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random({6, Stream::kTest, i});
    const CentreList line = {{-60, -0.11, 1}, {-20, -0.03, 2}, {20, 0.05, 1}, {60, 0.13, 0.5}};
    const CentreList other = observed_otherwise(line, random);
    const VelocityLine fit = robust_velocity_line(other);
    for (const ScatteringCentre& centre : other) EXPECT_NEAR(fit.residual(centre), 0, 1e-15);
  }
}

TEST(Augmentation, AddsErrorsOfTheStatedSize) {
  Random random({7, Stream::kTest, 0});
  const CentreList exact(20000, {5, 0.1, 1}), noisy = with_errors(exact, random);
  double range = 0, velocity = 0, level = 0;
  for (const ScatteringCentre& centre : noisy) {
    range += (centre.range_m - 5) * (centre.range_m - 5) / 20000;
    velocity += (centre.velocity_mps - 0.1) * (centre.velocity_mps - 0.1) / 20000;
    level += std::pow(20 * std::log10(centre.amplitude_m), 2) / 20000;
  }
  // Five standard errors of a standard deviation from 20,000 values: 5 / sqrt(40000) = 2.5 %.
  EXPECT_NEAR(std::sqrt(range), 0.02, 0.025 * 0.02);
  EXPECT_NEAR(std::sqrt(velocity), 0.001, 0.025 * 0.001);
  EXPECT_NEAR(std::sqrt(level), 1, 0.025);
}

}  // namespace
}  // namespace seaglint

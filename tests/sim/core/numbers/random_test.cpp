// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace seaglint {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Reference values of the authors' library Random123 (BSD-3-Clause, D. E. Shaw Research), tests/kat_vectors, lines
// "philox4x32 10".
TEST(Philox, EqualsTheReferenceValuesOfItsAuthors) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, ReturnsThePhiloxBlocksOfItsKey) {
  Random random({0x1122334455667788u, Stream::kNoise, 0x99aabbccddeeff00u});
  for (std::uint32_t block = 0; block < 3; ++block) {
    const Words words = philox4x32({block, 6, 0xddeeff00, 0x99aabbcc}, {0x55667788, 0x11223344});
    EXPECT_EQ(random.bits(), words[0] | std::uint64_t{words[1]} << 32);
    EXPECT_EQ(random.bits(), words[2] | std::uint64_t{words[3]} << 32);
  }
}

TEST(Random, DiffersWhenSeedStreamOrIndexDiffers) {
  const std::uint64_t base = Random({1, Stream::kTest, 1}).bits();
  EXPECT_EQ(Random({1, Stream::kTest, 1}).bits(), base);
  EXPECT_NE(Random({2, Stream::kTest, 1}).bits(), base);
  EXPECT_NE(Random({1, Stream::kNoise, 1}).bits(), base);
  EXPECT_NE(Random({1, Stream::kTest, 2}).bits(), base);
  EXPECT_NE(Random({std::uint64_t{1} << 32 | 1, Stream::kTest, 1}).bits(), base);
  EXPECT_NE(Random({1, Stream::kTest, std::uint64_t{1} << 32 | 1}).bits(), base);
}

// Values that must never change: every data set depends on them.
TEST(Random, RepeatsItsFirstNumbersOnEveryMachine) {
  Random uniform({42, Stream::kTest, 0});
  Random normal({42, Stream::kTest, 0});
  const double u = uniform.uniform();
  EXPECT_EQ(normal.normal(), normal_quantile(u));
  EXPECT_EQ(u, 0x1.6412144d0da85p-1);
  EXPECT_EQ(normal_quantile(u), 0x1.05d0f3f641605p-1);
}

TEST(Random, UniformStaysInsideTheOpenIntervalAndHasTheMomentsOfOne) {
  constexpr int kCount = 200000;
  Random random({7, Stream::kTest, 3});
  double sum = 0;
  double sum2 = 0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    sum2 += u * u;
  }
  // Five standard errors: variance of u is 1/12, of u^2 it is 4/45.
  EXPECT_NEAR(sum / kCount, 0.5, 5 * std::sqrt(1.0 / 12 / kCount));
  EXPECT_NEAR(sum2 / kCount, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / kCount));
}

TEST(Random, NormalHasTheMomentsAndTailsOfANormal) {
  constexpr int kCount = 200000;
  Random random({7, Stream::kTest, 4});
  double moment[5] = {};
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    for (int k = 1; k <= 4; ++k) moment[k] += std::pow(x, k) / kCount;
    beyond_two += std::abs(x) > 2 ? 1 : 0;
  }
  // Five standard errors: the variance of x^k is E x^2k - (E x^k)^2 = 1, 2, 15, 96.
  EXPECT_NEAR(moment[1], 0, 5 * std::sqrt(1.0 / kCount));
  EXPECT_NEAR(moment[2], 1, 5 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(moment[3], 0, 5 * std::sqrt(15.0 / kCount));
  EXPECT_NEAR(moment[4], 3, 5 * std::sqrt(96.0 / kCount));
  const double probability = std::erfc(2 / std::sqrt(2.0));
  EXPECT_NEAR(beyond_two, kCount * probability, 5 * std::sqrt(kCount * probability * (1 - probability)));
}

TEST(Random, BelowIsUnbiasedForCountsThatDoNotDivideTheRange) {
  constexpr std::uint32_t kCount = 3u << 30;  // a modulo would give the lower third twice as often
  constexpr int kDraws = 30000;
  Random random({7, Stream::kTest, 5});
  int lower_third = 0;
  for (int i = 0; i < kDraws; ++i) {
    const std::uint32_t x = random.below(kCount);
    ASSERT_LT(x, kCount);
    lower_third += x < kCount / 3 ? 1 : 0;
  }
  EXPECT_NEAR(lower_third, kDraws / 3.0, 5 * std::sqrt(kDraws * 2.0 / 9));
}

TEST(Random, BelowReachesEveryValueOfASmallCount) {
  Random random({7, Stream::kTest, 6});
  std::vector<int> seen(7);
  for (int i = 0; i < 7000; ++i) ++seen[random.below(7)];
  for (int count : seen) EXPECT_NEAR(count, 1000, 5 * std::sqrt(1000 * 6.0 / 7));
  EXPECT_EQ(random.below(1), 0u);
  EXPECT_THROW(random.below(0), std::logic_error);
}

// The three values printed in the paper of AS 241, section "Test data" (to 16 digits).
TEST(NormalQuantile, HasTheValuesOfItsPaper) {
  constexpr double kRelative = 1e-15;
  EXPECT_NEAR(normal_quantile(0.25), -0.6744897501960817, 0.6744897501960817 * kRelative);
  EXPECT_NEAR(normal_quantile(0.001), -3.090232306167814, 3.090232306167814 * kRelative);
  EXPECT_NEAR(normal_quantile(1e-20), -9.262340089798408, 9.262340089798408 * kRelative);
}

TEST(NormalQuantile, InvertsTheNormalDistribution) {
  for (double p = 1e-300; p < 0.999; p = p < 0.01 ? p * 3.7 : p + 0.0031) {
    const double x = normal_quantile(p);
    // A relative error e of x moves p by e x phi(x) ~ e x^2 p in the tail; erfc is good to a few ulp.
    const double tolerance = p * (1e-15 * (x * x + 1) + 4 * std::numeric_limits<double>::epsilon());
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)), p, 2 * tolerance) << "p = " << p;
  }
}

TEST(NormalQuantile, IsOddAboutOneHalfAndRejectsInvalidProbabilities) {
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  for (const double p : {0.03125, 0.25, 0.4375}) EXPECT_EQ(normal_quantile(p), -normal_quantile(1 - p));
  for (const double p : {0.0, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(normal_quantile(p), std::logic_error);
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
  EXPECT_GT(student_quantile(0.975, 9), student_quantile(0.975, 9.5));
  EXPECT_GT(student_quantile(0.975, 9.5), student_quantile(0.975, 10));
}

// Shape 1 is exponential: x = -ln Q. Shape 3: Q = e^{-x} (1 + x + x^2 / 2). Shape 1/2: P = erf(sqrt x). Equal tails
// within the rounding of Q or P, 1e-16 over the tail's slope.
TEST(GammaOfNormal, HasTheElementaryDistributions) {
  for (const double y : {-6.0, -2.0, -0.1, 0.0, 0.1, 2.0, 6.0}) {
    const double above = 0.5 * std::erfc(y / std::sqrt(2.0)), below = 0.5 * std::erfc(-y / std::sqrt(2.0));
    const double one = gamma_of_normal(1, y), three = gamma_of_normal(3, y), half = gamma_of_normal(0.5, y);
    EXPECT_NEAR(one / (y < 0 ? -std::log1p(-below) : -std::log(above)), 1, 1e-12) << y;
    EXPECT_NEAR(std::exp(-three) * (1 + three + three * three / 2) / above, 1, 1e-12) << y;
    EXPECT_NEAR(std::erf(std::sqrt(half)) / below, 1, 1e-12) << y;
  }
}

}  // namespace
}  // namespace seaglint

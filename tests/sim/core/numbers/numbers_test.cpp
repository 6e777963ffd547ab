// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/numbers/rotation.h"

namespace seaglint {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Laws of vectors, matrices and rotations, and their bits against those of Eigen, with which recorded results were
// computed.

constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();  // of a few operations on numbers of order 1
constexpr int kCases = 1000;

class Draw {
 public:
  double number() { return normal_(generator_); }
  Complex complex() { return {number(), number()}; }
  Vec2 plane() { return {number(), number()}; }
  Vec3 vector() { return {number(), number(), number()}; }
  CVec3 complex_vector() { return {complex(), complex(), complex()}; }
  Mat3 matrix() { return {vector(), vector(), vector()}; }

 private:
  std::mt19937_64 generator_{1};
  std::normal_distribution<double> normal_;
};

Eigen::Vector3d eigen(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3cd eigen(const CVec3& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Matrix3d eigen(const Mat3& m) {
  Eigen::Matrix3d out;
  for (int j = 0; j < 3; ++j) out.col(j) = eigen(m.col(j));
  return out;
}
Vec3 plain(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Mat3 plain(const Eigen::Matrix3d& m) {
  return {plain(Eigen::Vector3d(m.col(0))), plain(Eigen::Vector3d(m.col(1))), plain(Eigen::Vector3d(m.col(2)))};
}

TEST(Linear, CrossProductIsOrthogonalAndOfTheParallelogramsArea) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = draw.vector(), b = draw.vector(), c = a.cross(b);
    const double size = a.norm() * b.norm();
    EXPECT_NEAR(c.dot(a), 0, kRounding * size * a.norm());
    EXPECT_NEAR(c.dot(b), 0, kRounding * size * b.norm());
    EXPECT_NEAR(c.squaredNorm(), size * size - a.dot(b) * a.dot(b), kRounding * size * size);
    EXPECT_EQ(b.cross(a), -c);
  }
}

TEST(Linear, OrthogonalUnitVectorIsOneAlsoAlongTheAxes) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = n < 3 ? (n == 0 ? Vec3::UnitX() : n == 1 ? Vec3::UnitY() : Vec3::UnitZ()) : draw.vector();
    EXPECT_NEAR(a.unitOrthogonal().dot(a), 0, kRounding * a.norm());
    EXPECT_NEAR(a.unitOrthogonal().norm(), 1, kRounding);
  }
  EXPECT_EQ(Vec3::Zero().normalized(), Vec3::Zero());
}

TEST(Linear, ProductsOfMatricesAssociateAndTransposeInReverse) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Mat3 A = draw.matrix(), B = draw.matrix();
    const Vec3 v = draw.vector();
    const double size = A.norm() * B.norm();
    EXPECT_LE((A * B * v - A * (B * v)).norm(), kRounding * size * v.norm());
    EXPECT_LE((Mat3((A * B).transpose()) - Mat3(B.transpose()) * Mat3(A.transpose())).norm(), kRounding * size);
    EXPECT_LE((A.transpose() * v - Mat3(A.transpose()) * v).norm(), kRounding * A.norm() * v.norm());
    EXPECT_NEAR((A * B).determinant(), A.determinant() * B.determinant(), kRounding * size * size * size);
    EXPECT_NEAR((A * B).trace(), (B * A).trace(), kRounding * size);
  }
}

TEST(Linear, InverseTimesItsMatrixIsOne) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Mat3 A = draw.matrix(), inverse = A.inverse();
    const double condition = A.norm() * inverse.norm();
    EXPECT_LE((inverse * A - Mat3::Identity()).norm(), kRounding * condition * condition);
  }
}

TEST(Linear, OuterProductOfUnitVectorsProjects) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = draw.vector(), b = draw.vector(), v = draw.vector();
    EXPECT_LE((outer_product(a, b) * v - a * b.dot(v)).norm(), kRounding * a.norm() * b.norm() * v.norm());
    const Vec2 p = draw.plane(), q = draw.plane(), u = draw.plane();
    EXPECT_LE((outer_product(p, q) * u - p * q.dot(u)).norm(), kRounding * p.norm() * q.norm() * u.norm());
  }
}

TEST(Rotation, KeepsLengthsAndAnglesAndItsAxis) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 axis = draw.vector().normalized(), v = draw.vector();
    const double angle = kPi * draw.number();
    const Mat3 R = axis_rotation(angle, axis);
    EXPECT_NEAR((R * v).norm(), v.norm(), kRounding * v.norm());
    EXPECT_LE((R * axis - axis).norm(), kRounding);
    EXPECT_NEAR(R.trace(), 1 + 2 * std::cos(angle), kRounding);
    EXPECT_NEAR(R.determinant(), 1, kRounding);
    EXPECT_LE((axis_quaternion(angle, axis).matrix() - R).norm(), kRounding);
    EXPECT_LE((axis_quaternion(angle, axis) * v - R * v).norm(), kRounding * v.norm());
  }
}

TEST(Rotation, BetweenDirectionsTurnsOneIntoTheOther) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = draw.vector(), b = draw.vector();
    EXPECT_LE((rotation_between(a, b) * a.normalized() - b.normalized()).norm(),
              kRounding / (a.normalized() + b.normalized()).norm());
    EXPECT_LE((rotation_between(a, -a) * a + a).norm(), kRounding * a.norm());
  }
}

TEST(PrincipalAxes, DiagonaliseASymmetricMatrix) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Mat3 A = draw.matrix(), S = A + A.transpose();
    const PrincipalAxes found = principal_axes(S);
    EXPECT_TRUE(found.values[0] <= found.values[1] && found.values[1] <= found.values[2]);
    for (int k = 0; k < 3; ++k)
      EXPECT_LE((S * found.axes.col(k) - found.values[k] * found.axes.col(k)).norm(), kRounding * S.norm());
  }
}

TEST(Linear, HasTheBitsOfEigen) {
  Draw draw;
  for (int n = 0; n < kCases; ++n) {
    const Vec3 a = draw.vector(), b = draw.vector();
    const Mat3 A = draw.matrix(), B = draw.matrix();
    const CVec3 u = draw.complex_vector();
    const Complex c = draw.complex();
    const Eigen::Vector3d a_e = eigen(a), b_e = eigen(b);
    const Eigen::Matrix3d A_e = eigen(A), B_e = eigen(B);
    EXPECT_EQ(a.dot(b), a_e.dot(b_e));
    EXPECT_EQ(a.norm(), a_e.norm());
    EXPECT_EQ(a.sum(), a_e.sum());
    EXPECT_EQ(a.normalized(), plain(a_e.normalized()));
    EXPECT_EQ(a.cross(b), plain(a_e.cross(b_e)));
    EXPECT_EQ(a.unitOrthogonal(), plain(a_e.unitOrthogonal()));
    EXPECT_EQ(A * b, plain(Eigen::Vector3d(A_e * b_e)));
    EXPECT_EQ(A.transpose() * b, plain(Eigen::Vector3d(A_e.transpose() * b_e)));
    EXPECT_EQ(A * B, plain(Eigen::Matrix3d(A_e * B_e)));
    EXPECT_EQ(A * B.transpose(), plain(Eigen::Matrix3d(A_e * B_e.transpose())));
    EXPECT_EQ(A.inverse(), plain(Eigen::Matrix3d(A_e.inverse())));
    EXPECT_EQ(A.determinant(), A_e.determinant());
    EXPECT_EQ(A.trace(), A_e.trace());
    EXPECT_EQ(outer_product(a, b), plain(Eigen::Matrix3d(a_e * b_e.transpose())));
    EXPECT_EQ(a.dot(u), a_e.dot(eigen(u)));
    EXPECT_EQ(eigen(c * a), c * a_e);
    EXPECT_EQ(eigen(c * u), c * eigen(u));
    const Vec3 axis = a.normalized();
    EXPECT_EQ(axis_rotation(b.x(), axis), plain(Eigen::AngleAxisd(b.x(), eigen(axis)).toRotationMatrix()));
    const Eigen::Quaterniond q_e =
        Eigen::AngleAxisd(b.x(), eigen(axis)) * Eigen::AngleAxisd(b.y(), Eigen::Vector3d::UnitX());
    const Quaternion q = axis_quaternion(b.x(), axis) * axis_quaternion(b.y(), Vec3::UnitX());
    EXPECT_EQ(q.matrix(), plain(q_e.toRotationMatrix()));
    EXPECT_EQ(q * b, plain(q_e * b_e));
  }
}

TEST(RotationFromAngles, FollowsTheConventions) {
  const double quarter = kPi / 2;
  // Roll turns y (port) towards z; pitch puts the bow down; yaw turns the bow to port.
  EXPECT_NEAR((rotation_from_angles(quarter, 0, 0) * Vec3::UnitY() - Vec3::UnitZ()).norm(), 0, 1e-15);
  EXPECT_NEAR((rotation_from_angles(0, quarter, 0) * Vec3::UnitX() + Vec3::UnitZ()).norm(), 0, 1e-15);
  EXPECT_NEAR((rotation_from_angles(0, 0, quarter) * Vec3::UnitX() - Vec3::UnitY()).norm(), 0, 1e-15);
}

TEST(RotationFromAngles, IsYawTimesPitchTimesRoll) {
  const Mat3 product =
      rotation_from_angles(0, 0, 0.7) * rotation_from_angles(0, -0.3, 0) * rotation_from_angles(0.2, 0, 0);
  EXPECT_NEAR((rotation_from_angles(0.2, -0.3, 0.7) - product).norm(), 0, 1e-15);
}

TEST(Pose, MapsLocalCoordinatesToTheOuterFrame) {
  const Pose outer = upright(Vec3(1, 2, 3), kPi / 2);
  EXPECT_NEAR((outer * Vec3(1, 0, 0.5) - Vec3(1, 3, 3.5)).norm(), 0, 1e-15);
  const Pose inner{Vec3(0.3, -0.2, 0.1), rotation_from_angles(0.2, -0.3, 0.7)};
  const Vec3 local(0.4, 0.5, -0.6);
  EXPECT_NEAR(((outer * inner) * local - outer * (inner * local)).norm(), 0, 1e-15);
}

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
  double sum = 0, sum2 = 0;
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
  for (const double p : {0.0, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(normal_quantile(p), std::logic_error);
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

TEST(ReproducibleFunctions, AreLogarithmExponentialAndTangent) {
  for (double x = 1e-300; x < 1e300; x *= 1.7)
    EXPECT_NEAR(reproducible_log(x), std::log(x), 4e-16 * std::abs(std::log(x)) + 2e-16) << x;
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

// SPDX-License-Identifier: BSD-3-Clause
// Sums of chunks: bits that do not depend on the order in which they are complete, and the grid against a direct sum.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/sums/response_grid.h"
#include "sim/scattering/sums/sweep_sum.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// A sum whose rounding depends on its order.
struct Rounded {
  double value = 0;
  void add(const Rounded& other) { value += other.value; }
};

std::vector<double> terms_of_many_sizes(std::size_t count) {
  Random random({61, Stream::kTest, 0});
  std::vector<double> terms;
  for (std::size_t i = 0; i < count; ++i) terms.push_back(random.normal() * std::pow(10.0, 12 * random.uniform()));
  return terms;
}

TEST(OrderedSum, HasTheBitsOfTheOrderOfChunksInWhateverOrderTheyAreComplete) {
  const std::vector<double> terms = terms_of_many_sizes(6);
  double in_order = 0;
  for (const double term : terms) in_order += term;
  std::vector<std::size_t> order(terms.size());
  std::iota(order.begin(), order.end(), 0);
  std::set<std::uint64_t> unordered;
  do {
    OrderedSum<Rounded> sum({}, terms.size());
    double as_completed = 0;
    for (const std::size_t i : order) {
      sum.chunk(i).value = terms[i];
      sum.complete(i);
      as_completed += terms[i];
    }
    EXPECT_EQ(std::bit_cast<std::uint64_t>(sum.sum().value), std::bit_cast<std::uint64_t>(in_order));
    unordered.insert(std::bit_cast<std::uint64_t>(as_completed));
  } while (std::ranges::next_permutation(order).found);
  EXPECT_GT(unordered.size(), 1u);  // the order of completion would be visible
}

TEST(OrderedSum, HasTheBitsOfOneThreadWithAnyNumberOfThem) {
  const std::vector<double> terms = terms_of_many_sizes(3000);
  double in_order = 0;
  for (const double term : terms) in_order += term;
  for (const int threads : {1, 2, 7}) {
    OrderedSum<Rounded> sum({}, terms.size());
    parallel_for(terms.size(), threads, [&](std::size_t i) {
      sum.chunk(i).value = terms[i];
      sum.complete(i);
    });
    EXPECT_EQ(std::bit_cast<std::uint64_t>(sum.sum().value), std::bit_cast<std::uint64_t>(in_order)) << threads;
  }
}

TEST(OrderedSum, ContainsAChunkOnceItAndAllBeforeItAreCompleteAlsoWhereTheyWereNeverFilled) {
  OrderedSum<Rounded> sum({}, 5);
  sum.chunk(1).value = 10;
  sum.chunk(3).value = 1000;
  sum.complete(3);
  sum.complete(1);
  EXPECT_EQ(sum.sum().value, 0);  // the first is not complete
  sum.complete(0);
  EXPECT_EQ(sum.sum().value, 10);
  sum.complete(2);
  EXPECT_EQ(sum.sum().value, 1010);
  sum.complete(4);
  EXPECT_EQ(sum.sum().value, 1010);
}

// A band's cells are in the order of their first points, so that their sum has to keep the order of chunks.
TEST(OrderedSum, OfBandsHasEqualBitsInWhateverOrderTheyAreComplete) {
  const FrequencyBand band(wavenumber(9.3e9), wavenumber(9.5e9));
  constexpr std::size_t kChunks = 6;
  const auto sum_in = [&](const std::array<std::size_t, kChunks>& order) {
    OrderedSum<BandSum> sum(BandSum(band), kChunks);
    for (const std::size_t chunk : order) {
      Random random({62, Stream::kTest, chunk});
      for (int i = 0; i < 40 && chunk != 4; ++i) {
        Point point;
        point.psi = 3 * random.normal();
        for (Complex& element : point.pattern) element = {random.normal(), random.normal()};
        for (Complex& amplitude : point.amplitude) amplitude = random.normal();
        sum.chunk(chunk).add(point);
      }
      sum.complete(chunk);
    }
    return sum.sum().at(wavenumber(9.37e9));
  };
  const ScatteringMatrix expected = sum_in({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(sum_in({5, 4, 3, 2, 1, 0}), expected);
  EXPECT_EQ(sum_in({2, 0, 5, 4, 1, 3}), expected);
  EXPECT_GT(largest(expected), 0);
}

constexpr int kChannel = kHvChannel;

// Contributions whose phase is constant along them, so short that each is a point, over an interval of look directions.
struct IntervalOfPoints {
  LookDirectionPath path;
  PointBand at{FrequencyBand(40.0), 0, 0.02};
  WavenumberGrid wavenumbers{38, 0.05, 81};
  std::vector<Contribution> contributions;
  Observation observation;

  explicit IntervalOfPoints(double q_limit) {
    Random random({63, Stream::kTest, 0});
    const RadarBasis basis = radar_basis(direction(30, 10));
    path.along_track = {basis.h, Vec3::Zero()};
    path.cross_track = {basis.v, Vec3::Zero()};
    path.s_limit = 0.02;
    path.q_limit = q_limit;
    observation = {.antennas = monostatic(basis), .sense = PathSense::kOneWay};
    for (int i = 0; i < 200; ++i) {
      EdgeInterval interval;
      const Vec3 x(random.normal(), random.normal(), random.normal());
      interval.gradient.fill({x, x});
      interval.psi.fill(2 * x.dot(basis.r));
      interval.length = 0.6 * random.uniform();
      Contribution& contribution = contributions.emplace_back();
      contribution.element = interval;
      for (Complex& element : contribution.pattern.value) element = {random.normal(), random.normal()};
    }
  }
  const EdgeInterval& interval(std::size_t i) const { return *contributions[i].interval(); }
  Complex amplitude(std::size_t i) const { return interval(i).length * contributions[i].pattern.value[kChannel]; }

  // The contributions that are at least `faint` strong, s along the track and q across it, and the sum of their
  // magnitudes; path rates as of a gradient of at most `slide`, m.
  std::pair<Complex, double> direct(double k, double s, double q, double faint, double slide) const {
    Complex sum = 0;
    double size = 0;
    for (std::size_t i = 0; i < contributions.size(); ++i) {
      if (std::abs(amplitude(i)) < faint) continue;
      const Vec3 x = interval(i).gradient[0].transmit;
      const double limit = std::min(1.0, slide / (2 * x.norm()));
      const Vec3 turn = s * path.along_track.transmit + q * path.cross_track.transmit;
      sum += amplitude(i) * std::polar(1.0, k * (interval(i).psi[0] + limit * x.dot(turn)));
      size += std::abs(amplitude(i));
    }
    return {sum, size};
  }

  // In three of nine chunks, of which the first and the last stay empty.
  ResponseGrid grid(double faint, double slide, int threads) const {
    IntervalSum sum(path, at, {faint, slide, 6}, kChannel, 9);
    for (std::size_t i = 0; i < contributions.size(); ++i)
      sum.add(1 + 2 * (i % 3), std::span(&contributions[i], 1), observation);
    return sum.grid(wavenumbers, threads);
  }
};

constexpr double kKernel = 2 * (1e-5 + 7e-7);  // in psi and in u: the kernel, and the table of its values

constexpr double kNoLimit = 1e3;  // m

void expect_direct_sum(const IntervalOfPoints& of, double faint, double slide, double q, double series) {
  const ResponseGrid grid = of.grid(faint, slide, 1);
  for (const double s : {-0.02, -0.007, 0.0, 0.013, 0.02}) {
    std::vector<Complex> response(static_cast<std::size_t>(of.wavenumbers.count));
    grid.response(0, s, q, response);
    for (int n = 0; n < of.wavenumbers.count; n += 8) {
      const auto [sum, size] = of.direct(of.wavenumbers.at(n), s, q, faint, slide);
      EXPECT_LT(std::abs(response[n] - sum), (kKernel + series) * size) << s << ' ' << n;
    }
  }
}

TEST(IntervalSum, OfPointsIsTheirDirectSumAtEveryFrequencyAlongTheTrack) {
  expect_direct_sum(IntervalOfPoints(0), 0, kNoLimit, 0, 0);
}

TEST(IntervalSum, OfPointsIsTheirDirectSumAcrossTheTrackToTheOmittedTermOfTheSeries) {
  // k v q up to 42 x 6 x 0.004 = 1.01: the first term that is left out is 1.01^5 / 5!.
  expect_direct_sum(IntervalOfPoints(0.004), 0, kNoLimit, 0.004, std::pow(1.01, 5) / 120);
}

TEST(IntervalSum, LeavesOutContributionsThatAreFaint) {
  const IntervalOfPoints of(0);
  constexpr double kFaint = 0.2;
  EXPECT_LT(of.direct(40, 0, 0, kFaint, kNoLimit).second, of.direct(40, 0, 0, 0, kNoLimit).second - 1);
  expect_direct_sum(of, kFaint, kNoLimit, 0, 0);
}

TEST(IntervalSum, LimitsThePathRateToThatOfTheLongestGradient) {
  const IntervalOfPoints of(0);
  constexpr double kSlide = 2;  // m, the median of 2 |x| being 3.1
  const auto [limited, size] = of.direct(40, 0.02, 0, 0, kSlide);
  EXPECT_GT(std::abs(limited - of.direct(40, 0.02, 0, 0, kNoLimit).first), 10 * kKernel * size);
  expect_direct_sum(of, 0, kSlide, 0, 0);
}

TEST(IntervalSum, HasTheSameBitsForAnyNumberOfThreads) {
  const IntervalOfPoints of(0.004);
  const auto response = [&](int threads) {
    std::vector<Complex> values(static_cast<std::size_t>(of.wavenumbers.count));
    of.grid(0, kNoLimit, threads).response(0, 0.01, 0.003, values);
    return values;
  };
  const std::vector<Complex> one = response(1);
  for (const int threads : {2, 5}) EXPECT_EQ(response(threads), one) << threads;
}

}  // namespace
}  // namespace seaglint

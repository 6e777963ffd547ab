// SPDX-License-Identifier: BSD-3-Clause
// Points of random footprints and edges against quadratures of their phase integrals.
#include "sim/scattering/points/decomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/sim/scattering/points/random_contributions.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr double kRounding = 1e-10;  // of the quadrature and of cancelling end points, relative
const FormRange kForm = form_range(40);

Observation one_way(const Sample& sample) { return {.antennas = sample.antennas, .sense = PathSense::kOneWay}; }

std::vector<Point> points_of(const Sample& sample, const Observation& observation, const PointBand& at) {
  std::vector<Point> points;
  decompose(sample.contribution, observation, at, points);
  return points;
}

double sum_of_magnitudes(const std::vector<Point>& points) {
  double sum = 0;
  for (const Point& point : points) sum += std::abs(point.amplitude[0]);
  return sum;
}

// Footprints and edges of one and two antennas.
void for_each_sample(int count, std::uint64_t seed, const std::function<void(const Sample&, Random&)>& test) {
  Random random({seed, Stream::kTest, 0});
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    test(i % 2 == 0 ? random_footprint(random, i % 4 == 0) : random_edge(random, i % 4 == 1), random);
  }
}

const std::array<PointBand, 4> kBands{{{FrequencyBand(40.0)},
                                       {FrequencyBand(40.0), 0, 0.03},
                                       {FrequencyBand(1.01 * kForm.lowest, 0.99 * kForm.highest)},
                                       {FrequencyBand(1.01 * kForm.lowest, 0.99 * kForm.highest), 0, 0.03}}};

TEST(Decomposition, SumsToThePhaseIntegralAtEveryNode) {
  std::array<std::size_t, kBands.size()> points{};
  for_each_sample(60, 51, [&](const Sample& sample, Random&) {
    for (std::size_t b = 0; b < kBands.size(); ++b) {
      const std::vector<Point> of = points_of(sample, one_way(sample), kBands[b]);
      points[b] += of.size();
      for (std::size_t n = 0; n < kBands[b].band.nodes().size(); ++n) {
        const double k = kBands[b].band.nodes()[n];
        const Complex integral = quadrature(sample, k, [&](const PathGradient& x) { return two_way(sample, x); });
        for (int i = 0; i < 4; ++i) {
          Complex sum = 0;
          for (const Point& point : of) sum += point.matrix(n)[i] * std::polar(1.0, k * point.psi);
          const Complex pattern = sample.contribution.pattern.value[i];
          const double size = sum_of_magnitudes(of) + magnitude(sample, k);
          EXPECT_LT(std::abs(sum - pattern * integral), kRounding * size * std::abs(pattern)) << b << ' ' << n;
        }
      }
    }
  });
  EXPECT_EQ(points[0], 60u);  // a closed form each
  for (const std::size_t b : {1u, 2u, 3u}) EXPECT_GT(points[b], 80u) << b;
}

TEST(Decomposition, FollowsAChangeOfTheLookDirectionToTheErrorOfItsEndPoints) {
  constexpr double kChange = 0.03;
  int turned = 0;
  for_each_sample(100, 52, [&](const Sample& sample, Random& random) {
    const std::vector<Point> of = points_of(sample, one_way(sample), {FrequencyBand(40.0), 0, kChange});
    const Vec3 turn = kChange / 2 * random_vector(random).normalized();  // of both antennas
    const Complex integral =
        quadrature(sample, 40, [&](const PathGradient& x) { return two_way(sample, x) + x.sum().dot(turn); });
    const Complex pattern = sample.contribution.pattern.value[0];
    const double error = kMaxAmplitudeError * sum_of_magnitudes(of) * std::abs(pattern);
    EXPECT_LT(std::abs(direct_sum(of, 40, turn)[0] - pattern * integral), error);
    turned += std::abs(direct_sum(of, 40)[0] - pattern * integral) > error;
  });
  EXPECT_GT(turned, 30);  // for which the change matters
}

TEST(Decomposition, RefersThePhaseToTheOriginOfTheObservation) {
  for_each_sample(40, 53, [&](const Sample& sample, Random& random) {
    Observation moved = one_way(sample);
    moved.centre = random_vector(random);
    const Complex phase = std::polar(1.0, 40 * moved.centre.dot(moved.antennas.transmit.r + moved.antennas.receive.r));
    const ScatteringMatrix about_origin = scattered(sample.contribution, moved, 40),
                           about_centre = scattered(sample.contribution, one_way(sample), 40);
    for (int i = 0; i < 4; ++i)
      EXPECT_LT(std::abs(about_origin[i] - phase * about_centre[i]), 1e-13 * largest(about_centre));
    const std::vector<Point> there = points_of(sample, moved, kBands[1]),
                             here = points_of(sample, one_way(sample), kBands[1]);
    ASSERT_EQ(there.size(), here.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_LT((there[i].gradient.transmit - here[i].gradient.transmit - moved.centre).norm(), 1e-14);
      EXPECT_LT((there[i].gradient.receive - here[i].gradient.receive - moved.centre).norm(), 1e-14);
    }
  });
}

TEST(Decomposition, ExchangesAntennasWeighsAndTakesTheMeanOfBothSenses) {
  int slid = 0;
  for_each_sample(40, 54, [&](Sample sample, Random& random) {
    if (auto* footprint = std::get_if<Footprint>(&sample.contribution.element)) {
      for (MovingVertex& vertex : footprint->polygon) vertex.d1 += Vec2(random.normal(), random.normal());
    }
    const ScatteringMatrix traced = scattered(sample.contribution, one_way(sample), 40);
    Observation other = one_way(sample);
    other.weight = 0.7;
    const ScatteringMatrix weighted = scattered(sample.contribution, other, 40);
    for (int i = 0; i < 4; ++i) EXPECT_LT(std::abs(weighted[i] - 0.7 * traced[i]), 1e-15 * largest(traced));

    other = one_way(sample);
    other.sense = PathSense::kExchanged;
    const ScatteringMatrix exchanged = scattered(sample.contribution, other, 40);
    EXPECT_EQ(exchanged, (ScatteringMatrix{traced[0], traced[2], traced[1], traced[3]}));
    const std::vector<Point> back = points_of(sample, other, kBands[1]),
                             there = points_of(sample, one_way(sample), kBands[1]);
    ASSERT_EQ(back.size(), there.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      EXPECT_EQ(back[i].gradient.transmit, there[i].gradient.receive);
      EXPECT_EQ(back[i].gradient.receive, there[i].gradient.transmit);
      EXPECT_EQ(back[i].gradient.transmit_slide, there[i].gradient.receive_slide);
      EXPECT_EQ(back[i].gradient.receive_slide, there[i].gradient.transmit_slide);
      slid += there[i].gradient.transmit_slide != Vec3::Zero();
      EXPECT_EQ(back[i].psi, there[i].psi);
    }

    other.sense = PathSense::kMean;
    const ScatteringMatrix mean = scattered(sample.contribution, other, 40);
    const Complex cross = 0.5 * (traced[1] + traced[2]);
    const bool one = sample.antennas.monostatic;
    for (const int i : {kHvChannel, kVhChannel})
      EXPECT_LT(std::abs(mean[i] - (one ? cross : traced[i])), 1e-15 * largest(traced));
    EXPECT_EQ(mean[0], traced[0]);
    EXPECT_EQ(mean[3], traced[3]);
  });
  EXPECT_GT(slid, 20);
}

TEST(Decomposition, AtAFiniteRangeSumsToTheIntegralWithTheCurvedWavefront) {
  constexpr double kRange = 20, kReach = 2;
  int curved = 0;
  for_each_sample(60, 55, [&](const Sample& sample, Random& random) {
    Observation near = one_way(sample);
    near.radar = {kRange, 0.3 * random_vector(random)};
    near.direction_spread = kReach / kRange;
    const auto across = [](const Vec3& x, const Vec3& r) { return (x - r.dot(x) * r).squaredNorm(); };
    const Complex integral = quadrature(sample, 40, [&](const PathGradient& x) {
      return two_way(sample, x) - (across(near.radar.origin + x.transmit, near.antennas.transmit.r) +
                                   across(near.radar.origin + x.receive, near.antennas.receive.r)) /
                                      (2 * kRange);
    });
    const std::vector<Point> of = points_of(sample, near, {FrequencyBand(40.0)});
    const double error = kMaxAmplitudeError * sum_of_magnitudes(of);
    const Complex pattern = sample.contribution.pattern.value[0];
    EXPECT_LT(std::abs(direct_sum(of, 40)[0] / pattern - integral), error);
    curved += std::abs(scattered(sample.contribution, one_way(sample), 40)[0] / pattern - integral) > error;
  });
  EXPECT_GT(curved, 30);  // for which the curvature matters
}

TEST(Decomposition, FollowsAPatternThatIsLinearOverTheBandOfThreeNodes) {
  constexpr double kHalfBand = 2, kNode = 40;
  // (k - k_node) delta of 0.2 rad stands for its sine; amplitudes are frozen to rounding where psi is constant.
  constexpr double kSine = 0.2 * 0.2 / 6;
  Random random({56, Stream::kTest, 0});
  for (int trial = 0; trial < 20; ++trial) {
    Sample sample = random_edge(random, trial % 2 == 0);
    auto& interval = std::get<EdgeInterval>(sample.contribution.element);
    interval.psi[1] = interval.psi[0];
    interval.gradient[1] = interval.gradient[0];
    const ScatteringMatrix at_node = random_matrix(random), change = random_matrix(random);
    std::vector<ScatteringMatrix>& patterns = sample.contribution.pattern.at_node;
    for (const double side : {-1.0, 0.0, 1.0}) {
      patterns.push_back(at_node);
      for (int i = 0; i < 4; ++i) patterns.back()[i] += side * change[i];
    }
    const std::vector<Point> of = points_of(sample, one_way(sample), {FrequencyBand(kNode), 1, 0, kHalfBand});
    for (const double side : {-1.0, -0.6, 0.0, 0.3, 1.0}) {
      const double k = kNode + side * kHalfBand;
      const ScatteringMatrix sum = direct_sum(of, k);
      for (int i = 0; i < 4; ++i) {
        const Complex expected =
            interval.length * (at_node[i] + side * change[i]) * std::polar(1.0, k * interval.psi[0]);
        EXPECT_LT(std::abs(sum[i] - expected), interval.length * (kSine * std::abs(side * change[i]) + 1e-12)) << side;
      }
    }
  }
}

}  // namespace
}  // namespace seaglint

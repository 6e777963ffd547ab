// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/points/decomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/scattering/radiation/contribution.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Random footprints and edge intervals, and quadratures of their phase integrals.

struct GaussRule {
  std::vector<double> x, weight;  // on 0..1
};

// Gauss-Legendre: its nodes by Newton's method.
GaussRule gauss_rule(int n) {
  GaussRule rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int step = 0; step < 8; ++step) {
      double before = 1, here = x;
      for (int m = 2; m <= n; ++m) before = std::exchange(here, ((2 * m - 1) * x * here - (m - 1) * before) / m);
      slope = n * (x * here - before) / (x * x - 1);
      x -= here / slope;
    }
    rule.x.push_back(0.5 * (1 + x));
    rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

// Integral of e^{j phase(p)} over a convex polygon, m^2.
Complex area_integral(const MovingPolygon& polygon, const std::function<double(const Vec2&)>& phase) {
  static const GaussRule rule = gauss_rule(64);
  Complex sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[0].p, b = polygon[i].p - a, c = polygon[i + 1].p - a;
    const double twice_area = b.x() * c.y() - b.y() * c.x();
    for (std::size_t u = 0; u < rule.x.size(); ++u) {
      for (std::size_t v = 0; v < rule.x.size(); ++v) {
        const Vec2 p = a + rule.x[u] * (b + rule.x[v] * (c - b));
        sum += rule.weight[u] * rule.weight[v] * rule.x[u] * twice_area * std::polar(1.0, phase(p));
      }
    }
  }
  return sum;
}

Complex line_integral(double length, const std::function<double(double)>& phase) {
  static const GaussRule rule = gauss_rule(64);
  Complex sum = 0;
  for (std::size_t i = 0; i < rule.x.size(); ++i) sum += length * rule.weight[i] * std::polar(1.0, phase(rule.x[i]));
  return sum;
}

Vec3 random_vector(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

ScatteringMatrix random_matrix(Random& random) {
  ScatteringMatrix matrix;
  for (Complex& element : matrix) element = {random.normal(), random.normal()};
  return matrix;
}

// A footprint, or an interval of an edge, observed by two antennas or by one.
struct Sample {
  Contribution contribution;
  BistaticGeometry antennas;
};

BistaticGeometry random_antennas(Random& random, bool one) {
  const RadarBasis transmit = radar_basis(random_vector(random).normalized());
  return one ? monostatic(transmit) : bistatic(transmit, radar_basis(random_vector(random).normalized()));
}

ImageTransform random_image(Random& random, int reflections) {
  ImageTransform image;
  for (int i = 0; i < reflections; ++i)
    image = image * plane_reflection(random_vector(random).normalized(), random.uniform());
  return image;
}

// About 0.5 m wide, behind up to two reflections, its vertices fixed to the body.
Sample random_footprint(Random& random, bool one_antenna) {
  Sample sample;
  sample.contribution.pattern.value = random_matrix(random);
  sample.antennas = random_antennas(random, one_antenna);
  const RadarBasis& basis = sample.antennas.transmit;
  Footprint footprint;
  footprint.image_transform = random_image(random, static_cast<int>(random.below(3)));
  const Vec3 n = (basis.r + 0.4 * random_vector(random)).normalized();  // inclined, seldom by more than 60 degrees
  footprint.plane = depth_plane(n, 0.3 * random.normal(), basis);
  const Vec2 middle(0.3 * random.normal(), 0.3 * random.normal());
  const std::uint32_t vertices = 3 + random.below(4);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const double angle = 2 * kPi * (i + 0.6 * random.uniform()) / vertices;
    const Vec2 p = middle + Vec2(0.3 * std::cos(angle), 0.2 * std::sin(angle));
    const double z = footprint.plane.at(p);
    footprint.polygon.push_back({p, Vec2(-z, 0), Vec2(0, -z)});
  }
  for (const MovingVertex& a : footprint.polygon)
    for (const MovingVertex& b : footprint.polygon)
      footprint.panel_size = std::max(footprint.panel_size, footprint.surface_length(a.p - b.p));
  set_phase(footprint, n, sample.antennas);
  sample.contribution.element = footprint;
  return sample;
}

// Up to 1 m long, behind up to two reflections.
Sample random_edge(Random& random, bool one_antenna) {
  Sample sample;
  sample.contribution.pattern.value = random_matrix(random);
  sample.antennas = random_antennas(random, one_antenna);
  const ImageTransform image = random_image(random, static_cast<int>(random.below(3)));
  const Vec3 a = 0.3 * random_vector(random), b = a + random.uniform() * random_vector(random).normalized();
  EdgeInterval interval;
  interval.length = (b - a).norm();
  for (const int end : {0, 1}) {
    PathGradient& gradient = interval.gradient[end];
    gradient.receive = end == 0 ? a : b;
    gradient.transmit = image.image(gradient.receive);
    interval.psi[end] =
        gradient.transmit.dot(sample.antennas.transmit.r) + gradient.receive.dot(sample.antennas.receive.r);
  }
  sample.contribution.element = interval;
  return sample;
}

// Path gradient of a body-fixed point of the sample: `p` on a footprint, or p.x() of 0..1 along an edge.
PathGradient gradient_at(const Sample& sample, const Vec2& p) {
  if (const Footprint* footprint = sample.contribution.footprint())
    return phase_gradient(*footprint, p, sample.antennas.transmit);
  const EdgeInterval& interval = *sample.contribution.interval();
  return interpolate(interval.gradient[0], interval.gradient[1], p.x());
}

// The phase integral of the sample with k psi(gradient), and its factor -jk / 2 pi on a surface.
Complex quadrature(const Sample& sample, double k, const std::function<double(const PathGradient&)>& psi) {
  const auto phase = [&](const Vec2& p) { return k * psi(gradient_at(sample, p)); };
  if (const Footprint* footprint = sample.contribution.footprint())
    return Complex(0, -k / (2 * kPi)) * area_integral(footprint->polygon, phase);
  return line_integral(sample.contribution.interval()->length, [&](double s) { return phase({s, 0}); });
}
// Over a plane wave.
double two_way(const Sample& sample, const PathGradient& x) {
  return x.transmit.dot(sample.antennas.transmit.r) + x.receive.dot(sample.antennas.receive.r);
}
// That with phase 0.
double magnitude(const Sample& sample, double k) {
  return std::abs(quadrature(sample, k, [](const PathGradient&) { return 0.0; }));
}

// Points of random footprints and edges against quadratures of their phase integrals.

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
    if (auto* footprint = std::get_if<Footprint>(&sample.contribution.element))
      for (MovingVertex& vertex : footprint->polygon) vertex.d1 += Vec2(random.normal(), random.normal());
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

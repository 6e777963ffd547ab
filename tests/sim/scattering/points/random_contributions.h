// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Random footprints and edge intervals, and quadratures of their phase integrals.

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/scattering/radiation/contribution.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint::testing_echoes {

struct GaussRule {
  std::vector<double> x, weight;  // on 0..1
};

// Gauss-Legendre: its nodes by Newton's method.
inline GaussRule gauss_rule(int n) {
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
inline Complex area_integral(const MovingPolygon& polygon, const std::function<double(const Vec2&)>& phase) {
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

inline Complex line_integral(double length, const std::function<double(double)>& phase) {
  static const GaussRule rule = gauss_rule(64);
  Complex sum = 0;
  for (std::size_t i = 0; i < rule.x.size(); ++i) sum += length * rule.weight[i] * std::polar(1.0, phase(rule.x[i]));
  return sum;
}

inline Vec3 random_vector(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

inline ScatteringMatrix random_matrix(Random& random) {
  ScatteringMatrix matrix;
  for (Complex& element : matrix) element = {random.normal(), random.normal()};
  return matrix;
}

// A footprint, or an interval of an edge, observed by two antennas or by one.
struct Sample {
  Contribution contribution;
  BistaticGeometry antennas;
};

inline BistaticGeometry random_antennas(Random& random, bool one) {
  const RadarBasis transmit = radar_basis(random_vector(random).normalized());
  return one ? monostatic(transmit) : bistatic(transmit, radar_basis(random_vector(random).normalized()));
}

inline ImageTransform random_image(Random& random, int reflections) {
  ImageTransform image;
  for (int i = 0; i < reflections; ++i)
    image = image * plane_reflection(random_vector(random).normalized(), random.uniform());
  return image;
}

// About 0.5 m wide, behind up to two reflections, its vertices fixed to the body.
inline Sample random_footprint(Random& random, bool one_antenna) {
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
  for (const MovingVertex& a : footprint.polygon) {
    for (const MovingVertex& b : footprint.polygon)
      footprint.panel_size = std::max(footprint.panel_size, footprint.surface_length(a.p - b.p));
  }
  set_phase(footprint, n, sample.antennas);
  sample.contribution.element = footprint;
  return sample;
}

// Up to 1 m long, behind up to two reflections.
inline Sample random_edge(Random& random, bool one_antenna) {
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
inline PathGradient gradient_at(const Sample& sample, const Vec2& p) {
  if (const Footprint* footprint = sample.contribution.footprint())
    return phase_gradient(*footprint, p, sample.antennas.transmit);
  const EdgeInterval& interval = *sample.contribution.interval();
  return interpolate(interval.gradient[0], interval.gradient[1], p.x());
}

// The phase integral of the sample with k psi(gradient), and its factor -jk / 2 pi on a surface.
inline Complex quadrature(const Sample& sample, double k, const std::function<double(const PathGradient&)>& psi) {
  const auto phase = [&](const Vec2& p) { return k * psi(gradient_at(sample, p)); };
  if (const Footprint* footprint = sample.contribution.footprint())
    return Complex(0, -k / (2 * kPi)) * area_integral(footprint->polygon, phase);
  return line_integral(sample.contribution.interval()->length, [&](double s) { return phase({s, 0}); });
}
// Over a plane wave.
inline double two_way(const Sample& sample, const PathGradient& x) {
  return x.transmit.dot(sample.antennas.transmit.r) + x.receive.dot(sample.antennas.receive.r);
}
// That with phase 0.
inline double magnitude(const Sample& sample, double k) {
  return std::abs(quadrature(sample, k, [](const PathGradient&) { return 0.0; }));
}

}  // namespace seaglint::testing_echoes

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/points/phase_integral.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/sinc.h"
#include "sim/scattering/points/curved_integral.h"

namespace seaglint {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Integral of e^{jk w.(p - c)} over the polygon about its centroid c, by a series in k w: for k |w| size below 0.1 the
// truncation error is below 1e-6 of the area.
Complex small_phase_integral(const MovingPolygon& polygon, const Vec2& c, const Vec2& kw) {
  // Moments of the phase over a triangle with vertex phases x, y, z from complete homogeneous sums.
  Complex sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[0].p - c, b = polygon[i].p - c, d = polygon[i + 1].p - c;
    const double area = 0.5 * cross(b - a, d - a);
    const double x = kw.dot(a), y = kw.dot(b), z = kw.dot(d);
    // Complete homogeneous sums: h_m(x, y, z) = x h_{m-1}(x, y, z) + h_m(y, z), and h_m(y, z) = y h_{m-1}(y, z) + z^m.
    const double b1 = y + z, b2 = y * b1 + z * z, b3 = y * b2 + z * z * z, b4 = y * b3 + z * z * z * z;
    const double h1 = x + b1, h2 = x * h1 + b2, h3 = x * h2 + b3, h4 = x * h3 + b4;
    // Mean of phase^m over a triangle is 2 m! h_m / (m + 2)!; the exponential divides by m!.
    sum += area * Complex(1 - 2 * h2 / 24 + 2 * h4 / 720, 2 * h1 / 6 - 2 * h3 / 120);
  }
  return sum;
}

}  // namespace

Complex flat_phase_integral(const Footprint& footprint, const MovingPolygon& polygon, double k) {
  const Vec2 c = centroid(polygon);
  const Complex phase_c = std::polar(1.0, k * footprint.psi(c));
  const Vec2 kw = k * footprint.w;
  double largest = 0;
  for (const MovingVertex& vertex : polygon) largest = std::max(largest, std::abs(kw.dot(vertex.p - c)));
  if (largest < 0.1) return phase_c * small_phase_integral(polygon, c, kw);

  Complex sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i].p - c, along = polygon[(i + 1) % polygon.size()].p - polygon[i].p;
    sum += cross(kw, along) * half_argument_sinc(kw.dot(along)) * std::polar(1.0, kw.dot(a + 0.5 * along));
  }
  return phase_c * sum / (Complex(0, 1) * kw.squaredNorm());
}

Complex phase_integral(const Footprint& footprint, double k) {
  if (!footprint.curvature) return flat_phase_integral(footprint, footprint.polygon, k);
  std::vector<CurvedContribution> terms;
  curved_contributions(footprint, FrequencyBand(k), 0, terms);
  Complex sum = 0;
  for (const CurvedContribution& term : terms) sum += term.integral[0] * std::polar(1.0, k * term.psi);
  return sum;
}

std::array<Complex, 4> scattered(const Footprint& footprint, double k, std::size_t index) {
  const std::array<Complex, 4>& pattern = footprint.patterns.empty() ? footprint.pattern : footprint.patterns[index];
  std::array<Complex, 4> s{};
  if (footprint.curvature) {
    std::vector<CurvedContribution> terms;
    curved_contributions(footprint, FrequencyBand(k), 0, terms);
    for (const CurvedContribution& term : terms) {
      const Complex value = Complex(0, -k / (2 * kPi)) * term.integral[0] * std::polar(1.0, k * term.psi);
      const auto local = pattern_at(footprint, term.p, pattern);
      for (int i = 0; i < 4; ++i) s[i] += value * local[i];
    }
    return s;
  }
  const Complex factor = Complex(0, -k / (2 * kPi)) * phase_integral(footprint, k);
  for (int i = 0; i < 4; ++i) s[i] = factor * pattern[i];
  return s;
}

}  // namespace seaglint

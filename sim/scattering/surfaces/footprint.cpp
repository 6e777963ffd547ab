// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/surfaces/footprint.h"

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/surfaces/curved_footprint.h"

namespace seaglint {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

Vec3 image_point(const Footprint& footprint, const Vec2& p, const RadarBasis& basis) {
  return p.x() * basis.h + p.y() * basis.v + footprint.plane.at(p) * basis.r;
}

// Integral of e^{jk w.(p - c)} over the polygon about its centroid c, by the first terms of its series in k w: for k
// |w| size below 0.1 the terms left out are below 1e-6 of the area.
Complex small_phase_integral(const MovingPolygon& polygon, const Vec2& c, const Vec2& kw) {
  // Moments of the phase over a triangle with corner phases x, y, z: the mean of a polynomial from complete homogeneous
  // sums.
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

RadarBasis radar_basis(const Vec3& r_hat) {
  RadarBasis basis;
  basis.r = r_hat;
  const Vec3 across = Vec3::UnitZ().cross(r_hat);
  basis.h = across.norm() < 1e-12 ? Vec3(Vec3::UnitY()) : Vec3(across.normalized());
  basis.v = r_hat.cross(basis.h);
  return basis;
}

AntennaPair monostatic(const RadarBasis& basis) { return {basis, basis, true}; }

AntennaPair bistatic(const RadarBasis& transmit, const RadarBasis& receive) { return {transmit, receive, false}; }

MovingLine ImagePlane::moving() const {
  MovingLine line;
  line.value = z0;
  line.gradient = slope;
  line.value_d1 = slope.x() * z0;
  line.value_d2 = slope.y() * z0;
  line.gradient_d1 = Vec2::UnitX() + slope.x() * slope;
  line.gradient_d2 = Vec2::UnitY() + slope.y() * slope;
  return line;
}

ImagePlane image_plane(const Vec3& n, double offset, const RadarBasis& basis) {
  const double nr = n.dot(basis.r);
  return {offset / nr, Vec2(-n.dot(basis.h) / nr, -n.dot(basis.v) / nr)};
}

void set_phase(Footprint& footprint, const Vec3& n_image, const AntennaPair& antennas) {
  // psi = r^_t.X' + r^_s.X = (r^_t + L r^_s).X' + constant; over the aperture X' = p1 h + p2 v + r^_t z(p).
  const RadarBasis& basis = antennas.transmit;
  const Mat3& L = footprint.mirrors.L;
  const Vec3 both = basis.r + L * antennas.receive.r;
  footprint.w = Vec2(both.dot(basis.h), both.dot(basis.v)) + both.dot(basis.r) * footprint.plane.slope;
  const Vec3 origin = image_point(footprint, Vec2::Zero(), basis);
  footprint.psi0 = basis.r.dot(origin) + antennas.receive.r.dot(footprint.mirrors.real(origin));
  // Along the facet the gradient is the tangential part of r^ + L r^; turning r^ by e changes it by that of e + L e (of
  // two directions, which turn about as one, too).
  const auto tangential = [&](const Vec3& x) -> Vec3 { return x - n_image * n_image.dot(x); };
  footprint.surface_slope = tangential(both).norm();
  footprint.surface_slope_turn =
      std::sqrt(tangential(basis.h + L * basis.h).squaredNorm() + tangential(basis.v + L * basis.v).squaredNorm());
}

PathGradient phase_gradient(const Footprint& footprint, const Vec2& p, const RadarBasis& transmit) {
  PathGradient gradient;
  gradient.transmit = image_point(footprint, p, transmit);
  gradient.receive = footprint.mirrors.real(gradient.transmit);
  return gradient;
}

PathGradient between(const PathGradient& a, const PathGradient& b, double s) {
  const auto mean = [s](const Vec3& from, const Vec3& to) -> Vec3 { return from + s * (to - from); };
  return {mean(a.transmit, b.transmit), mean(a.receive, b.receive), mean(a.transmit_slip, b.transmit_slip),
          mean(a.receive_slip, b.receive_slip)};
}

namespace {

// A body-fixed point at height z moves by -z d_i in the aperture; what the corner moves beyond that, it slips in the
// facet.
std::array<Vec2, 2> slips(const Footprint& footprint, const Corner& corner) {
  const double z = footprint.plane.at(corner.p);
  return {corner.d1 + Vec2(z, 0), corner.d2 + Vec2(0, z)};
}

}  // namespace

PathGradient phase_gradient(const Footprint& footprint, const Corner& corner, const RadarBasis& transmit) {
  const auto [slip1, slip2] = slips(footprint, corner);
  PathGradient gradient = phase_gradient(footprint, corner.p, transmit);
  gradient.transmit_slip = footprint.w.dot(slip1) * transmit.h + footprint.w.dot(slip2) * transmit.v;
  gradient.transmit += gradient.transmit_slip;
  return gradient;
}

void limit_slip(Footprint& footprint, double most) {
  for (Corner& corner : footprint.polygon) {
    const auto [slip1, slip2] = slips(footprint, corner);
    const double squared = slip1.squaredNorm() + slip2.squaredNorm();
    if (squared <= most * most) continue;
    const double too_much = 1 - most / std::sqrt(squared);
    corner.d1 -= too_much * slip1;
    corner.d2 -= too_much * slip2;
  }
}

double sinc(double x) {
  const double half = 0.5 * x;
  return std::abs(half) < 1e-4 ? 1 - half * half / 6 : std::sin(half) / half;
}

Complex phase_integral(const Footprint& footprint, double k) {
  if (footprint.curvature) {
    std::vector<CurvedTerm> terms;
    curved_terms(footprint, k, 0, terms);
    Complex sum = 0;
    for (const CurvedTerm& term : terms) sum += term.integral * std::polar(1.0, k * term.psi);
    return sum;
  }
  const MovingPolygon& polygon = footprint.polygon;
  const Vec2 c = centroid(polygon);
  const Complex phase_c = std::polar(1.0, k * footprint.psi(c));
  const Vec2 kw = k * footprint.w;
  double largest = 0;
  for (const Corner& corner : polygon) largest = std::max(largest, std::abs(kw.dot(corner.p - c)));
  if (largest < 0.1) return phase_c * small_phase_integral(polygon, c, kw);

  Complex sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i].p - c, along = polygon[(i + 1) % polygon.size()].p - polygon[i].p;
    sum += cross(kw, along) * sinc(kw.dot(along)) * std::polar(1.0, kw.dot(a + 0.5 * along));
  }
  return phase_c * sum / (Complex(0, 1) * kw.squaredNorm());
}

std::array<Complex, 4> scattered(const Footprint& footprint, double k, std::size_t index) {
  const std::array<Complex, 4>& pattern = footprint.patterns.empty() ? footprint.pattern : footprint.patterns[index];
  std::array<Complex, 4> s{};
  if (footprint.curvature) {
    std::vector<CurvedTerm> terms;
    curved_terms(footprint, k, 0, terms);
    for (const CurvedTerm& term : terms) {
      const Complex value = Complex(0, -k / (2 * kPi)) * term.integral * std::polar(1.0, k * term.psi);
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

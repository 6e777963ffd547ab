// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/contribution.h"

#include <cmath>
#include <utility>

#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/coefficients/fade_windows.h"

namespace seaglint {
namespace {

Vec3 image_point(const Footprint& footprint, const Vec2& p, const RadarBasis& basis) {
  return p.x() * basis.h + p.y() * basis.v + footprint.plane.at(p) * basis.r;
}

}  // namespace

Pattern& Pattern::operator+=(const Pattern& other) {
  if (at_node.empty()) at_node.assign(other.at_node.size(), value);
  for (std::size_t q = 0; q < at_node.size(); ++q) add_to(at_node[q], other.at(q));
  add_to(value, other.value);
  return *this;
}

Pattern& Pattern::operator*=(double factor) {
  for (Complex& element : value) element *= factor;
  for (ScatteringMatrix& matrix : at_node) {
    for (Complex& element : matrix) element *= factor;
  }
  return *this;
}

Pattern transposed(Pattern pattern) {
  std::swap(pattern.value[1], pattern.value[2]);
  for (ScatteringMatrix& matrix : pattern.at_node) std::swap(matrix[1], matrix[2]);
  return pattern;
}

Pattern reciprocal_mean(Pattern pattern, const Pattern& back) {
  pattern += transposed(back);
  pattern *= 0.5;
  return pattern;
}

void set_phase(Footprint& footprint, const Vec3& n_image, const BistaticGeometry& geometry) {
  // psi = r^_t.X' + r^_s.X = (r^_t + L r^_s).X' + constant; in the projection plane X' = p1 h + p2 v + r^_t z(p).
  const RadarBasis& basis = geometry.transmit;
  const Mat3& L = footprint.image_transform.L;
  const Vec3 both = basis.r + L * geometry.receive.r;
  footprint.w = Vec2(both.dot(basis.h), both.dot(basis.v)) + both.dot(basis.r) * footprint.plane.slope;
  const Vec3 origin = image_point(footprint, Vec2::Zero(), basis);
  footprint.psi0 = basis.r.dot(origin) + geometry.receive.r.dot(footprint.image_transform.real(origin));
  // Along the panel the gradient is the tangential part of r^ + L r^; a change e of r^ changes it by that of e + L e
  // (for two directions too, whose changes are nearly equal).
  const auto tangential = [&](const Vec3& x) -> Vec3 { return x - n_image * n_image.dot(x); };
  footprint.psi_slope = tangential(both).norm();
  footprint.psi_slope_rate =
      std::sqrt(tangential(basis.h + L * basis.h).squaredNorm() + tangential(basis.v + L * basis.v).squaredNorm());
}

PathGradient phase_gradient(const Footprint& footprint, const Vec2& p, const RadarBasis& transmit) {
  PathGradient gradient;
  gradient.transmit = image_point(footprint, p, transmit);
  gradient.receive = footprint.image_transform.real(gradient.transmit);
  return gradient;
}

namespace {

// Slide of a vertex on the panel: its motion beyond that of a body-fixed point at height z, -z d_i.
std::array<Vec2, 2> slides(const Footprint& footprint, const MovingVertex& vertex) {
  const double z = footprint.plane.at(vertex.p);
  return {vertex.d1 + Vec2(z, 0), vertex.d2 + Vec2(0, z)};
}

}  // namespace

PathGradient phase_gradient(const Footprint& footprint, const MovingVertex& vertex, const RadarBasis& transmit) {
  const auto [slip1, slip2] = slides(footprint, vertex);
  PathGradient gradient = phase_gradient(footprint, vertex.p, transmit);
  gradient.transmit_slide = footprint.w.dot(slip1) * transmit.h + footprint.w.dot(slip2) * transmit.v;
  gradient.transmit += gradient.transmit_slide;
  return gradient;
}

void limit_slide_rate(Footprint& footprint, double max) {
  for (MovingVertex& vertex : footprint.polygon) {
    const auto [slip1, slip2] = slides(footprint, vertex);
    const double squared = slip1.squaredNorm() + slip2.squaredNorm();
    if (squared <= max * max) continue;
    const double too_much = 1 - max / std::sqrt(squared);
    vertex.d1 -= too_much * slip1;
    vertex.d2 -= too_much * slip2;
  }
}

namespace {

// k (psi_1 - psi_0), kept away from 0, where the end-point terms are infinite: changes the integral by at most this
// fraction.
double phase_difference(const EdgeInterval& interval, double k) {
  constexpr double kMin = 1e-3;  // rad
  const double run = k * (interval.psi[1] - interval.psi[0]);
  return std::abs(run) < kMin ? std::copysign(kMin, run) : run;
}

}  // namespace

double EdgeInterval::fresnel_taper(double k) const { return smooth_taper(fresnel_wavenumber / k, kFresnelDepthWindow); }

Complex endpoint_term(const EdgeInterval& interval, double k, double fraction) {
  const double run = phase_difference(interval, k);
  const auto at_fraction = [&](const auto& law) { return law.at(k, fraction, run); };
  return interval.fresnel_taper(k) * interval.length / Complex(0, run) * std::visit(at_fraction, interval.amplitude);
}

bool endpoints_suffice(const EdgeInterval& interval, double k) {
  return !std::holds_alternative<DoubleKnifeEdge>(interval.amplitude) ||
         DoubleKnifeEdge::endpoints_suffice(k * (interval.psi[1] - interval.psi[0]));
}

Complex interval_integral(const EdgeInterval& interval, double k, double from, double to) {
  const double phase = k * (interval.psi[1] - interval.psi[0]) * (to - from);
  const double length = interval.fresnel_taper(k) * interval.length * (to - from);
  if (std::holds_alternative<UniformAmplitude>(interval.amplitude)) return length * half_argument_sinc(phase);
  const auto* knives = std::get_if<DoubleKnifeEdge>(&interval.amplitude);
  if (knives && !DoubleKnifeEdge::endpoints_suffice(phase)) return length * knives->mean(k, phase, from, to);
  const Complex half = std::polar(1.0, 0.5 * (to - from) * phase_difference(interval, k));
  return endpoint_term(interval, k, to) * half - endpoint_term(interval, k, from) * std::conj(half);
}

}  // namespace seaglint

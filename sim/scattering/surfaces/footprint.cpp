// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/surfaces/footprint.h"

#include <cmath>

namespace seaglint {
namespace {

Vec3 image_point(const Footprint& footprint, const Vec2& p, const RadarBasis& basis) {
  return p.x() * basis.h + p.y() * basis.v + footprint.plane.at(p) * basis.r;
}

}  // namespace

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

}  // namespace seaglint

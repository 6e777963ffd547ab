// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/thick_edge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

constexpr Complex j(0, 1);

// Direction relative to the edge: angle from the sheet's extension, positive on the side of the first face, and sine of
// the angle to the edge.
struct EdgeAngle {
  double phi = 0;    // -pi..pi
  double sin_b = 1;  // > 0
};

EdgeAngle about(const WedgeFrame& wedge, const Vec3& towards) {
  const WedgeFace& face = wedge.face[0];
  const double out = -towards.dot(face.x), up = towards.dot(face.n);
  constexpr double kMinSine = 1e-6;
  return {std::atan2(up, out), std::max(std::hypot(out, up), kMinSine)};
}

// (1 - gamma - ln(kappa t / 2 pi) - j pi / 2) / pi, kappa = k sin b: the logarithm of the square end.
FirstOrderThickness<Complex> end_logarithm(double sin_b) {
  return {(1 - std::numbers::egamma - std::log(sin_b / (2 * kPi)) - 0.5 * j * kPi) / kPi, -1 / kPi};
}

// 2 delta P / kappa t without the logarithm, whose factors are given separately.
struct ThicknessTerms {
  double soft = 0, hard = 0;
  double soft_log = 0, hard_log = 0;  // cos(phi/2) cos(phi0/2) and sin(phi/2) sin(phi0/2)
};

// Terms for two directions; the phase refers to the face that both are in front of, else to the middle of the sheet.
ThicknessTerms thickness_terms(double phi, double phi0) {
  const double side = phi * phi0 < 0 ? -1 : 1;
  // On the reflection and the shadow boundary the fractions below are 0/0, in the sheet's plane doubly: both are
  // avoided.
  constexpr double kAside = 1e-5;
  const auto off_the_sheet = [](double angle) { return std::clamp(std::abs(angle), 10 * kAside, kPi - 10 * kAside); };
  double a = off_the_sheet(phi), a0 = off_the_sheet(phi0);
  if (const double beyond = a + a0 - kPi; std::abs(beyond) < kAside) {
    const double aside = 0.5 * (std::copysign(kAside, beyond) - beyond);
    a += aside;
    a0 += aside;
  }
  const double c = std::cos(a), s = std::sin(a), c0 = std::cos(a0), s0 = std::sin(a0);
  const double CC = std::cos(a / 2) * std::cos(a0 / 2), SS = side * std::sin(a / 2) * std::sin(a0 / 2);
  const double currents = (a * s + a0 * s0) / kPi, face = side > 0 ? s + s0 : 0;
  return {-CC * (currents + 2 * SS - face) / (c + c0), (SS * currents + 0.5 * (1 + c * c0) - face * SS) / (c + c0), -CC,
          SS};
}

}  // namespace

std::array<FirstOrderThickness<CVec3>, 2> thick_edge_currents(const WedgeFrame& wedge, const Vec3& k_hat,
                                                              const std::array<Vec3, 2>& fields, const Vec3& s) {
  const EdgeAngle in = about(wedge, -k_hat), out = about(wedge, s);
  const ThicknessTerms terms = thickness_terms(out.phi, in.phi);
  // Off Keller's cone: geometric mean of both waves' sines, which is reciprocal.
  const double sin_b = std::sqrt(in.sin_b * out.sin_b);
  const FirstOrderThickness<Complex> end = end_logarithm(sin_b);
  const Complex soft = terms.soft + terms.soft_log * end.constant, hard = terms.hard + terms.hard_log * end.constant;
  const Vec3& t = wedge.face[0].t;
  const Vec3 e_hard = t.cross(s);
  std::array<FirstOrderThickness<CVec3>, 2> currents;
  for (int i = 0; i < 2; ++i) {
    // S per metre is j / (pi sin^2 b) times the amplitude P of the fields along t, E_t along t and H_t along t x s;
    // delta P has the factor kappa t / 2.
    const Complex E_t = j / (2 * kPi * sin_b) * fields[i].dot(t),
                  H_t = j / (2 * kPi * sin_b) * k_hat.cross(fields[i]).dot(t);
    currents[i].constant = soft * E_t * t.cast<Complex>() + hard * H_t * e_hard.cast<Complex>();
    currents[i].logarithm =
        end.logarithm * (terms.soft_log * E_t * t.cast<Complex>() + terms.hard_log * H_t * e_hard.cast<Complex>());
  }
  return currents;
}

FirstOrderThickness<Complex> thick_edge_wave_change(const WedgeFrame& wedge, const Vec3& towards) {
  const auto [phi, sin_b] = about(wedge, towards);
  const double C = std::cos(phi / 2), S = std::sin(std::abs(phi) / 2);
  const FirstOrderThickness<Complex> end = end_logarithm(sin_b);
  const Complex all = -j * sin_b * S;
  return {all * (S * end.constant + C * (1 - std::abs(phi) / kPi)), all * S * end.logarithm};
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/canonical/canonical_echo.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

double cosine_of_deg(double angle) { return std::cos(radians(angle)); }

// Dyad of a polarisation-dependent scatterer in the basis of one antenna: p . D . q.
std::array<Complex, 4> in_basis(const Mat3& dyad, const RadarBasis& basis) {
  return {basis.h.dot(dyad * basis.h), basis.h.dot(dyad * basis.v), basis.v.dot(dyad * basis.h),
          basis.v.dot(dyad * basis.v)};
}

// Effective aperture of a triangular trihedral of unit legs for ascending direction cosines l <= m <= n.
double triangular_aperture(double l, double m, double n) {
  const double sum = l + m + n;
  return l + m <= n ? 4 * l * m / sum : sum - 2 / sum;
}

}  // namespace

MieSeries::MieSeries(double ka) {
  SEAGLINT_CHECK(ka > 0, "a sphere has a size");
  // Beyond order ka the coefficients fall as those of an Airy function of (n - ka) / cbrt(ka): below rounding here.
  constexpr double kLargest = 1e200;  // of xi, whose coefficients are then 0
  const auto count = static_cast<std::size_t>(ka + 8 * std::cbrt(ka) + 12);
  // Riccati-Bessel functions psi_n, chi_n by upward recurrence. Where psi_n < chi_n its error is rounding of chi_n, to
  // which the coefficients relate it.
  double psi_before = std::cos(ka), psi = std::sin(ka), chi_before = -std::sin(ka), chi = std::cos(ka);
  for (std::size_t n = 1; n <= count; ++n) {
    const double order = static_cast<double>(n), factor = (2 * order - 1) / ka;
    const double psi_n = factor * psi - psi_before, chi_n = factor * chi - chi_before;
    // psi_n' = psi_{n-1} - n psi_n / x, xi = psi - i chi. Infinite refractive index of eqs. (4.56), (4.57).
    const Complex xi(psi_n, -chi_n), xi_before(psi, -chi);
    if (std::abs(chi_n) > kLargest) break;
    a_.push_back((psi - order * psi_n / ka) / (xi_before - order * xi / ka));
    b_.push_back(psi_n / xi);
    psi_before = psi;
    psi = psi_n;
    chi_before = chi;
    chi = chi_n;
  }
}

std::pair<Complex, Complex> MieSeries::amplitudes(double cosine) const {
  Complex normal = 0, parallel = 0;
  double pi_before = 0, pi = 1;  // angle functions of order n - 1, n; eq. (4.47)
  for (std::size_t i = 0; i < a_.size(); ++i) {
    const double n = static_cast<double>(i) + 1;
    const double tau = n * cosine * pi - (n + 1) * pi_before, factor = (2 * n + 1) / (n * (n + 1));
    normal += factor * (a_[i] * pi + b_[i] * tau);
    parallel += factor * (a_[i] * tau + b_[i] * pi);
    const double next = ((2 * n + 1) * cosine * pi - (n + 1) * pi_before) / n;
    pi_before = pi;
    pi = next;
  }
  return {normal, parallel};
}

CanonicalSolution::CanonicalSolution(const CanonicalBody& body, double frequency_hz)
    : body_(body), wavenumber_(2 * kPi * frequency_hz / kSpeedOfLight) {
  if (body.shape == CanonicalShape::kSphere) mie_.emplace(wavenumber_ * body.a_m);
}

std::optional<CanonicalEcho> CanonicalSolution::at(const BistaticGeometry& geometry) const {
  if (mie_) return of_sphere(geometry);
  if (!geometry.monostatic) return std::nullopt;
  return of_reflector(geometry.receive);
}

// E_parallel,s = e^{ikr} / (-ikr) S_2 E_parallel,i and likewise S_1 (eq. 3.12), with e_parallel x e_normal = d: in the
// conjugate time factor the amplitude in metres is -j conj(S) / k.
CanonicalEcho CanonicalSolution::of_sphere(const BistaticGeometry& geometry) const {
  const Vec3 incident = -geometry.transmit.r, scattered = geometry.receive.r;
  const double cosine = std::clamp(incident.dot(scattered), -1.0, 1.0);
  const auto [normal, parallel] = mie_->amplitudes(cosine);
  constexpr double kInLine = 1e-9;  // sine of an angle whose plane is any
  const Vec3 across = scattered.cross(incident);
  const Vec3 e_normal = across.norm() > kInLine ? Vec3(across.normalized()) : geometry.transmit.h;
  const Vec3 e_in = incident.cross(e_normal), e_out = scattered.cross(e_normal);
  const Complex turn =
      std::polar(1 / wavenumber_, wavenumber_ * body_.centre_m.dot(geometry.transmit.r + geometry.receive.r));
  const Complex s_normal = Complex(0, -1) * std::conj(normal) * turn,
                s_parallel = Complex(0, -1) * std::conj(parallel) * turn;
  const auto element = [&](const Vec3& received, const Vec3& transmitted) {
    return s_normal * received.dot(e_normal) * transmitted.dot(e_normal) +
           s_parallel * received.dot(e_out) * transmitted.dot(e_in);
  };
  const RadarBasis &t = geometry.transmit, &r = geometry.receive;
  return {{element(r.h, t.h), element(r.h, t.v), element(r.v, t.h), element(r.v, t.v)}, 0};
}

std::optional<CanonicalEcho> CanonicalSolution::of_reflector(const RadarBasis& basis) const {
  constexpr double kLeastSide = 20, kEdges = 3;  // k a, and times 1 / (k a)
  const double side = wavenumber_ * (body_.b_m > 0 ? std::min(body_.a_m, body_.b_m) : body_.a_m);
  if (side < kLeastSide) return std::nullopt;
  const Vec3 r = body_.axes.transpose() * basis.r;  // along the axes
  double aperture = 0;
  Complex factor(0, 1);
  Mat3 dyad = Mat3::Identity();
  if (body_.shape == CanonicalShape::kPlate) {
    constexpr double kMainLobe = 0.708;  // 3 dB
    const double pattern = half_argument_sinc(2 * wavenumber_ * body_.a_m * r.x()) *
                           half_argument_sinc(2 * wavenumber_ * body_.b_m * r.y());
    if (std::abs(r.z()) < 0.5 || pattern < kMainLobe) return std::nullopt;
    aperture = body_.a_m * body_.b_m * std::abs(r.z()) * pattern;
    factor = -factor;
  } else if (body_.shape == CanonicalShape::kDihedral) {
    constexpr double kOffBisector_deg = 0.5, kAlongSeam = 0.966;
    const double off = std::abs(std::atan2(r.y(), r.x()) - kPi / 4);
    const double pattern = half_argument_sinc(2 * wavenumber_ * body_.b_m * r.z());
    if (off > radians(kOffBisector_deg) || std::abs(r.z()) > 0.5 || pattern < kAlongSeam) return std::nullopt;
    aperture = 2 * body_.a_m * body_.b_m * std::sin(kPi / 4 - off) * pattern;
    const Vec3 seam = body_.axes.col(2);
    dyad = outer_product(2 * seam, seam) - Mat3::Identity();
  } else {
    const bool triangular = body_.shape == CanonicalShape::kTriangularTrihedral;
    if (r.sum() / std::sqrt(3.0) < cosine_of_deg(triangular ? 5 : 1)) return std::nullopt;
    std::array<double, 3> cosines{r.x(), r.y(), r.z()};
    std::ranges::sort(cosines);
    aperture =
        body_.a_m * body_.a_m * (triangular ? triangular_aperture(cosines[0], cosines[1], cosines[2]) : std::sqrt(3.0));
  }
  CanonicalEcho echo{in_basis(dyad, basis), kEdges / side};
  const Complex amplitude =
      factor * std::polar(aperture * wavenumber_ / (2 * kPi), 2 * wavenumber_ * body_.centre_m.dot(basis.r));
  for (Complex& element : echo.matrix_m) element *= amplitude;
  return echo;
}

}  // namespace seaglint

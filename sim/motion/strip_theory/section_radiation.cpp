// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/strip_theory/section_radiation.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/numbers/constants.h"

namespace seaglint {

Complex LewisForm::point(double alpha) const {
  const Complex zeta = std::polar(1.0, alpha);
  return scale * (zeta + a1 / zeta + a3 / (zeta * zeta * zeta));
}

Complex LewisForm::derivative(double alpha) const {
  const Complex zeta = std::polar(1.0, alpha);
  return Complex(0, 1) * scale * (zeta - a1 / zeta - 3 * a3 / (zeta * zeta * zeta));
}

// Half of pi M^2 (1 - sum n a_n^2), the area within the image of a circle.
double LewisForm::area() const { return 0.5 * kPi * scale * scale * (1 - a1 * a1 - 3 * a3 * a3); }

// int z dA = int y z dz over both sides, by the midpoint rule (relative error below 1e-6).
double LewisForm::area_centre() const {
  constexpr int kPoints = 512;
  double moment = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double alpha = -0.5 * kPi * (i + 0.5) / kPoints;
    const Complex p = point(alpha);
    moment += 2 * p.real() * p.imag() * derivative(alpha).imag();
  }
  return moment * 0.5 * kPi / kPoints / area();
}

// A form is valid while its breadth does not decrease towards the waterline nor its depth towards the keel, and it does
// not cross the axes; for the area coefficient s: 3 pi/32 (2 - H) <= s <= pi/32 (H + 1/H + 10) with H the smaller of
// half-breadth/draught and its reciprocal (von Kerczek and Tuck 1969).
AreaRange lewis_area_range(double half_breadth_to_draught) {
  const double h = std::min(half_breadth_to_draught, 1 / half_breadth_to_draught);
  return {3 * kPi / 32 * (2 - h), kPi / 32 * (h + 1 / h + 10)};
}

// Breadth/2 = M (1 + a1 + a3) and draught = M (1 - a1 + a3) give a1 = (1 + a3) q, q = (H - 1)/(H + 1); the area is then
// quadratic in a3: with s = area/(breadth draught) and c = 3 + 4 s/pi + (1 - 4 s/pi) q^2,
// c a3^2 + 2 (c - 3) a3 + (c - 4) = 0, larger root.
LewisForm lewis_form(double breadth, double draught, double area) {
  const double h = 0.5 * breadth / draught;
  const double q = (h - 1) / (h + 1);
  const AreaRange range = lewis_area_range(h);
  const double s = std::clamp(area / (breadth * draught), range.least, range.largest);
  const double c = 3 + 4 * s / kPi + (1 - 4 * s / kPi) * q * q;
  LewisForm form;
  // At the maximum area 9 - 2 c is 0 to rounding, of either sign.
  form.a3 = (3 - c + std::sqrt(std::max(0.0, 9 - 2 * c))) / c;
  form.a1 = q * (1 + form.a3);
  form.scale = 0.5 * breadth / (1 + form.a1 + form.a3);
  return form;
}

namespace {

// E1(z) = -gamma - ln z - sum_{n>=1} (-z)^n / (n n!); converges everywhere; rounding is amplified by e^{|z| - Re z}.
Complex by_series(Complex z) {
  Complex term = 1, sum = 0;
  for (int n = 1; n < 200; ++n) {
    term *= -z / static_cast<double>(n);
    const Complex next = term / static_cast<double>(n);
    sum += next;
    if (std::abs(next) < 1e-17 * std::abs(sum)) break;
  }
  // On the cut the value from above is used, independent of the sign of a zero imaginary part.
  const Complex logarithm(std::log(std::abs(z)), std::atan2(std::abs(z.imag()), z.real()));
  return std::exp(z) * (-std::numbers::egamma - logarithm - sum);
}

// e^z E1(z) = 1/(z + 1/(1 + 1/(z + 2/(1 + 2/(z + ...))))), evaluated from its tail; converges away from the negative
// axis.
Complex by_fraction(Complex z) {
  Complex tail = 0;
  for (int n = 80; n >= 1; --n) tail = static_cast<double>(n) / (1.0 + static_cast<double>(n) / (z + tail));
  return 1.0 / (z + tail);
}

// e^z E1(z) ~ 1/z sum_n n! / (-z)^n up to the smallest term, which is of the order of e^{-|z|}.
Complex by_asymptotic_series(Complex z) {
  Complex term = 1, sum = 0;
  for (int n = 1; std::abs(term) > 1e-17; ++n) {
    sum += term;
    const Complex next = term * static_cast<double>(n) / -z;
    if (std::abs(next) >= std::abs(term)) break;
    term = next;
  }
  return sum / z;
}

}  // namespace

Complex scaled_exponential_integral(Complex z) {
  if (std::abs(z) > 24) return by_asymptotic_series(z);
  if (std::abs(z) > 4 && (z.real() > 0 || z.imag() > 6)) return by_fraction(z);
  return by_series(z);
}

namespace {

constexpr Complex kI{0, 1};      // of the plane y + i z
constexpr int kMultipoles = 12;  // wave-free potentials per symmetry; doubling changes the added mass by less than 1e-3

// Gauss-Legendre points on [0, 1].
struct GaussRule {
  std::array<double, kContourPoints> place, weight;
  GaussRule() {
    constexpr int n = kContourPoints;
    for (int i = 0; i < n; ++i) {
      double x = std::cos(kPi * (i + 0.75) / (n + 0.5)), slope = 1;
      for (int iteration = 0; iteration < 100; ++iteration) {
        double p0 = 1, p1 = x;
        for (int m = 2; m <= n; ++m) {
          const double p2 = ((2 * m - 1) * x * p1 - (m - 1) * p0) / m;
          p0 = p1;
          p1 = p2;
        }
        slope = n * (x * p1 - p0) / (x * x - 1);
        const double step = p1 / slope;
        x -= step;
        if (std::abs(step) < 1e-15) break;
      }
      place[static_cast<std::size_t>(i)] = 0.5 * (1 - x);
      weight[static_cast<std::size_t>(i)] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

// Potential and stream function, n.grad(phi) = d psi/dl from keel to waterline, both real functions of position times a
// complex time amplitude.
struct Flow {
  Complex potential, stream;
};

// Of the analytic function f(y + i z), real in time.
Flow flow_of(Complex f) { return {f.real(), f.imag()}; }

// Source and dipole of one frequency at the origin, evaluated at y + i z with y >= 0. The source is
// int_0^inf e^{kz} cos(ky)/(k - K) dk with outgoing waves: principal value - j pi e^{Kz} cos(Ky). With Z = z + i y the
// principal value is the real part of e^{KZ} (E1(KZ) + i pi) (by rotating the contour of k into the upper half plane);
// its conjugate is analytic in y + i z.
class OriginWaves {
 public:
  OriginWaves(Complex place, double wavenumber)
      : z_(place.imag(), place.real()),
        wavenumber_(wavenumber),
        wave_(std::exp(wavenumber * z_)),
        principal_(scaled_exponential_integral(wavenumber * z_) + kI * kPi * wave_) {}

  Flow source() const { return with_wave(principal_, wave_); }
  // y derivative of the source, times a length.
  Flow dipole(double length) const {
    const Complex slope = length * kI * (wavenumber_ * principal_ - 1.0 / z_);
    return with_wave(slope, length * kI * wavenumber_ * wave_);
  }

 private:
  static Flow with_wave(Complex principal, Complex wave) {
    return {Complex(principal.real(), -kPi * wave.real()), Complex(-principal.imag(), kPi * wave.imag())};
  }

  Complex z_;
  double wavenumber_;
  Complex wave_, principal_;
};

// zeta^{-n} on the contour, n = 0, 1, ...
constexpr int kPowers = 2 * kMultipoles + 5;
using Powers = std::array<Complex, kPowers>;
Powers powers_of(double alpha) {
  Powers powers;
  powers[0] = 1;
  const Complex inverse = std::polar(1.0, -alpha);
  for (std::size_t n = 1; n < kPowers; ++n) powers[n] = powers[n - 1] * inverse;
  return powers;
}

// Wave-free potential f = zeta^{-n} + i K M (zeta^{-(n-1)}/(n-1) - a1 zeta^{-(n+1)}/(n+1) - 3 a3 zeta^{-(n+3)}/(n+3)):
// on the free surface, where zeta is real, Re(K f dw/dzeta - i df/dzeta) = 0 term by term, which is K phi = d phi/dz.
// Even n is even in y, odd n odd (Ursell 1949 for the circle; Tasai 1959 for Lewis forms).
Flow multipole(const LewisForm& form, const Powers& power, double wavenumber, std::size_t n) {
  const auto m = static_cast<double>(n);
  const Complex tail = power[n - 1] / (m - 1) - form.a1 * power[n + 1] / (m + 1) - 3 * form.a3 * power[n + 3] / (m + 3);
  return flow_of(power[n] + kI * wavenumber * form.scale * tail);
}

const GaussRule& gauss() {
  static const GaussRule rule;
  return rule;
}

double alpha_at(std::size_t i) { return -0.5 * kPi * (1 - gauss().place[i]); }

}  // namespace

Contour contour_of(const LewisForm& form) {
  Contour contour;
  for (std::size_t i = 0; i < kContourPoints; ++i) {
    const Complex p = form.point(alpha_at(i));
    const Complex d = form.derivative(alpha_at(i)) * (0.5 * kPi * gauss().weight[i]);
    contour.y[i] = p.real();
    contour.z[i] = p.imag();
    contour.dy[i] = d.real();
    contour.dz[i] = d.imag();
  }
  return contour;
}

// Amplitudes of the potentials by a least-squares fit of the stream function on the contour (de Jong 1973): a wall
// velocity V requires d psi = V.n dl, so psi = z in sway, -y in heave, -(y^2 + z^2)/2 in roll; in the odd modes, whose
// stream function does not vanish below the keel, up to a constant.
SectionRadiation solve_radiation(const LewisForm& form, const Contour& contour, double wavenumber) {
  using Matrix = Eigen::Matrix<Complex, kContourPoints, Eigen::Dynamic, 0, kContourPoints, kMultipoles + 2>;
  constexpr int kUnknowns = kMultipoles + 1;
  Matrix even(kContourPoints, kUnknowns), odd(kContourPoints, kUnknowns + 1);
  Matrix even_potential(kContourPoints, kUnknowns), odd_potential(kContourPoints, kUnknowns);
  Eigen::Matrix<Complex, kContourPoints, 1> heave;
  Eigen::Matrix<Complex, kContourPoints, 2> sway_roll;
  for (std::size_t i = 0; i < kContourPoints; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Powers powers = powers_of(alpha_at(i));
    const Complex place(contour.y[i], contour.z[i]);
    const OriginWaves waves(place, wavenumber);
    const auto put = [row](Matrix& stream, Matrix& potential, Eigen::Index column, const Flow& flow) {
      stream(row, column) = flow.stream;
      potential(row, column) = flow.potential;
    };
    put(even, even_potential, 0, waves.source());
    put(odd, odd_potential, 0, waves.dipole(form.scale));
    for (int m = 1; m <= kMultipoles; ++m) {
      const std::size_t n = 2 * static_cast<std::size_t>(m);
      put(even, even_potential, m, multipole(form, powers, wavenumber, n));
      put(odd, odd_potential, m, multipole(form, powers, wavenumber, n + 1));
    }
    odd(row, kUnknowns) = 1;
    heave(row) = -contour.y[i];
    sway_roll(row, 0) = contour.z[i];
    sway_roll(row, 1) = -0.5 * std::norm(place);
  }
  const Eigen::VectorXcd up = even.colPivHouseholderQr().solve(heave);
  const Eigen::MatrixXcd across = odd.colPivHouseholderQr().solve(sway_roll);

  SectionRadiation result;
  const Eigen::VectorXcd heave_potential = even_potential * up;
  const Eigen::MatrixXcd across_potential = odd_potential * across.topRows(kUnknowns);
  for (std::size_t i = 0; i < kContourPoints; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    result.potential[kSway][i] = across_potential(row, 0);
    result.potential[kHeave][i] = heave_potential(row);
    result.potential[kRoll][i] = across_potential(row, 1);
  }
  // In the far field the source is -j pi e^{-jK|y|}, the dipole -pi K length; eta = -(1/g) d phi/dt of a velocity jw.
  const double dipole_wave = kPi * wavenumber * wavenumber * form.scale;
  result.radiated_wave_ratio = {dipole_wave * std::abs(across(0, 0)), kPi * wavenumber * std::abs(up(0)),
                                dipole_wave * std::abs(across(0, 1))};
  const auto largest = [](const auto& v) { return v.cwiseAbs().maxCoeff(); };
  const Eigen::MatrixXcd across_error = odd * across - sway_roll;
  result.residual = {largest(across_error.col(0)) / largest(sway_roll.col(0)),
                     largest(even * up - heave) / largest(heave),
                     largest(across_error.col(1)) / largest(sway_roll.col(1))};
  return result;
}

Complex SectionRadiation::integral(const Contour& c, SectionMode force, SectionMode motion) const {
  Complex sum = 0;
  for (std::size_t i = 0; i < kContourPoints; ++i) {
    const double normal = force == kSway    ? c.dz[i]
                          : force == kHeave ? -c.dy[i]
                                            : -(c.y[i] * c.dy[i] + c.z[i] * c.dz[i]);
    sum += 2 * normal * potential[motion][i];
  }
  return sum;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/core/constants.h"
#include "sim/core/error.h"

namespace seaglint {

namespace {

// Peak enhancement gamma^r - 1, r = exp(-(u-1)^2 / (2 s^2)), s = 0.07 below the peak and 0.09 above (Hasselmann et al.
// 1973, "Measurements of wind-wave growth and swell decay during JONSWAP", Deutsche Hydrogr. Z. A8(12), eq. 2.4.1).
double enhancement(double u, double gamma) {
  const double s = u <= 1 ? 0.07 : 0.09;
  const double z = (u - 1) / s;
  return std::expm1(std::log(gamma) * std::exp(-0.5 * z * z));
}

// Integral over [a, b] by Gauss and Legendre's five points on pieces no longer than `piece`.
template <typename Function>
double integrate(double a, double b, double piece, const Function& f) {
  constexpr std::array<double, 3> x{0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> w{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const int pieces = std::max(1, static_cast<int>(std::ceil((b - a) / piece)));
  const double half = 0.5 * (b - a) / pieces;
  double sum = 0;
  for (int p = 0; p < pieces; ++p) {
    const double middle = a + (2 * p + 1) * half;
    sum += w[0] * f(middle);
    for (std::size_t i = 1; i < 3; ++i) sum += w[i] * (f(middle - half * x[i]) + f(middle + half * x[i]));
  }
  return sum * half;
}

}  // namespace

JonswapSpectrum::JonswapSpectrum(double significant_wave_height_m, double peak_period_s, double gamma,
                                 SpectrumNormalisation normalisation)
    : peak_omega_(2 * kPi / peak_period_s), gamma_(gamma) {
  SEAGLINT_CHECK(significant_wave_height_m > 0 && peak_period_s > 0 && gamma >= 1,
                 fmt::format("Hs = {} m, Tp = {} s, gamma = {}", significant_wave_height_m, peak_period_s, gamma));
  // The integral of u^-5 exp(-1.25 u^-4) is exp(-1.25 u^-4) / 5, so Pierson-Moskowitz with (5/16) Hs^2 holds Hs^2/16.
  scale_ = 5.0 / 16 * significant_wave_height_m * significant_wave_height_m;
  if (normalisation == SpectrumNormalisation::kExact) {
    scale_ /= 1 + 5 * enhancement_integral(0, std::numeric_limits<double>::infinity());
  } else {
    scale_ *= 1 - 0.287 * std::log(gamma);  // DNV-RP-C205 (2010), section 3.5.5.2
  }
}

double JonswapSpectrum::shape(double u) const {
  if (!(u > 0)) return 0;
  const double u4 = u * u * u * u;
  return std::exp(-1.25 / u4) / (u4 * u) * (1 + enhancement(u, gamma_));
}

double JonswapSpectrum::density(double omega) const { return scale_ / peak_omega_ * shape(omega / peak_omega_); }

// What the peak enhancement adds to the integral of the shape; beyond u = 0.3 and 1.9 (ten standard deviations) it adds
// nothing that a double could hold.
double JonswapSpectrum::enhancement_integral(double lower, double upper) const {
  const auto added = [this](double u) {
    return std::exp(-1.25 / (u * u * u * u)) / std::pow(u, 5) * enhancement(u, gamma_);
  };
  constexpr double kPiece = 0.02;
  const auto part = [&](double a, double b) {
    const double from = std::max(a, lower);
    const double to = std::min(b, upper);
    return from < to ? integrate(from, to, kPiece, added) : 0.0;
  };
  return part(0.3, 1) + part(1, 1.9);  // s jumps at the peak
}

double JonswapSpectrum::energy(double lower, double upper) const {
  const auto cumulative = [](double u) { return u > 0 ? 0.2 * std::exp(-1.25 / (u * u * u * u)) : 0.0; };
  const double a = std::max(0.0, lower / peak_omega_);
  const double b = std::max(a, upper / peak_omega_);
  return scale_ * (cumulative(b) - cumulative(a) + enhancement_integral(a, b));
}

double JonswapSpectrum::energy_above(double omega) const {
  const double u = std::max(0.0, omega / peak_omega_);
  const double pierson_moskowitz = u > 0 ? -0.2 * std::expm1(-1.25 / (u * u * u * u)) : 0.2;
  return scale_ * (pierson_moskowitz + enhancement_integral(u, std::numeric_limits<double>::infinity()));
}

double linear_cutoff(const SeaState& state) {
  return state.cutoff_rad_s > 0 ? state.cutoff_rad_s : std::max(8.0, 8 * kPi / state.peak_period_s);
}

double second_order_cutoff(const SeaState& state) {
  if (state.second_order_cutoff_rad_s > 0) return state.second_order_cutoff_rad_s;
  return state.significant_wave_height_m > 0 ? std::sqrt(2 * kGravity / state.significant_wave_height_m)
                                             : std::numeric_limits<double>::infinity();
}

}  // namespace seaglint

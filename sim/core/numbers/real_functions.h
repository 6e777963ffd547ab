// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Functions of real numbers: integrals of smooth functions, sin(x/2)/(x/2), transitions between two values; levels in
// dBsm; quantiles of samples.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/linear.h"

namespace seaglint {

// Integral over [a, b] by five-point Gauss-Legendre quadrature on subintervals of at most `piece`.
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

// (e^{jx} - 1)/(jx) e^{-jx/2} = sin(x/2)/(x/2), to rounding; by its power series for |x| < 1.
inline double half_argument_sinc(double x) {
  const double half = 0.5 * x, y = half * half;
  if (y >= 0.25) return std::sin(half) / half;
  return 1 - y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110 * (1 - y / 156)))));
}

// Smooth taper: 1 for x <= from_to[0], 0 for x >= from_to[1].
inline double smooth_taper(double x, const std::array<double, 2>& from_to) {
  const double beyond = std::clamp((x - from_to[0]) / (from_to[1] - from_to[0]), 0.0, 1.0);
  return 1 - beyond * beyond * (3 - 2 * beyond);
}

// Linear interpolation between two ends, at a fraction of the interval from the first.
template <typename T>
T interpolate(const std::array<T, 2>& ends, double fraction) {
  return ends[0] + fraction * (ends[1] - ends[0]);
}

inline constexpr double kMinArea_m2 = 1e-100;  // floor for an exact zero, -1000 dBsm

// Level of a radar cross-section in m^2, dBsm; at least that of min_m2.
inline double dbsm_of_area(double area_m2, double min_m2 = kMinArea_m2) {
  return 10 * std::log10(std::max(area_m2, min_m2));
}

// Level of a scattering amplitude s in metres, 4 pi |s|^2, dBsm; at least that of min_m2.
inline double dbsm(const Complex& s, double min_m2 = kMinArea_m2) {
  return dbsm_of_area(4 * kPi * std::norm(s), min_m2);
}

// Magnitude in metres of an amplitude of this level in dBsm.
inline double amplitude_of_dbsm(double level_dbsm) { return std::sqrt(std::pow(10.0, level_dbsm / 10) / (4 * kPi)); }

// Quantile of ascending values at probability p, 0 <= p <= 1, linearly interpolated between the ranks p (n - 1)
// (Hyndman and Fan, The American Statistician 50 (1996) 361, type 7); NaN without values.
double quantile(std::span<const double> ascending, double p);

// Lower quartile, median and upper quartile of the finite values; NaN without any.
struct Quartiles {
  double lower = 0;
  double median = 0;
  double upper = 0;
};
Quartiles quartiles(std::vector<double> values);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/gamma_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr int kMaxTerms = 10000;  // a = 1000 needs about 400
constexpr double kEpsilon = 1e-16;

// ln Gamma(a) by Stirling's series (Abramowitz and Stegun 6.1.41) after a shift to a >= 10. std::lgamma writes a global
// sign.
double log_gamma(double a) {
  double shift = 0;
  while (a < 10) {
    shift += std::log(a);
    a += 1;
  }
  const double x = 1 / (a * a);
  const double series =
      (1.0 / 12 - x * (1.0 / 360 - x * (1.0 / 1260 - x * (1.0 / 1680 - x * (1.0 / 1188 - x * 691.0 / 360360))))) / a;
  return (a - 0.5) * std::log(a) - a + 0.5 * std::log(2 * kPi) + series - shift;
}

// x^a e^{-x} / Gamma(a)
double front_factor(double a, double x) { return std::exp(a * std::log(x) - x - log_gamma(a)); }

// Abramowitz and Stegun 6.5.29: P = x^a e^{-x} / Gamma(a) sum_n x^n / (a (a+1) ... (a+n)); for x < a + 1.
double p_by_series(double a, double x) {
  double term = 1 / a;
  double sum = term;
  for (int n = 1; n < kMaxTerms && term > kEpsilon * sum; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return front_factor(a, x) * sum;
}

// Abramowitz and Stegun 6.5.31, the even part of the continued fraction by Lentz's method; for x >= a + 1.
double q_by_fraction(double a, double x) {
  double b = x + 1 - a;
  double c = 1e300;
  double d = 1 / b;
  double value = d;
  for (int n = 1; n < kMaxTerms; ++n) {
    const double numerator = -n * (n - a);
    b += 2;
    d = 1 / (numerator * d + b);
    c = b + numerator / c;
    value *= c * d;
    if (std::abs(c * d - 1) < 4 * kEpsilon) break;
  }
  return front_factor(a, x) * value;
}

}  // namespace

double gamma_p(double a, double x) {
  SEAGLINT_CHECK(a > 0 && x >= 0, fmt::format("a = {}, x = {}", a, x));
  if (x == 0) return 0;
  return x < a + 1 ? p_by_series(a, x) : 1 - q_by_fraction(a, x);
}

double gamma_q(double a, double x) {
  SEAGLINT_CHECK(a > 0 && x >= 0, fmt::format("a = {}, x = {}", a, x));
  if (x == 0) return 1;
  return x < a + 1 ? 1 - p_by_series(a, x) : q_by_fraction(a, x);
}

double gamma_texture(double shape, double normal) {
  SEAGLINT_CHECK(shape >= 0.1 && shape <= 1000, fmt::format("shape = {}", shape));
  // The smaller tail is used to preserve precision: P in the lower half, Q in the upper.
  const bool lower = normal < 0;
  const double tail = 0.5 * std::erfc(std::abs(normal) / std::sqrt(2.0));
  // Solved for y = ln x, where both tails are smooth: Newton's method on ln(tail), safeguarded by bisection. First
  // guess: Wilson and Hilferty (1931), or the first term of the series where that is not positive.
  const double root = 1 - 1 / (9 * shape) + normal / (3 * std::sqrt(shape));
  double y = root > 0.1 ? std::log(shape) + 3 * std::log(root) : (std::log(tail * shape) + log_gamma(shape)) / shape;
  double low = -1e4, high = std::log(shape + 1e4);
  for (int i = 0; i < 200; ++i) {
    y = std::clamp(y, low, high);
    const double x = std::exp(y);
    const double value = x == 0 ? (lower ? 0.0 : 1.0) : lower ? gamma_p(shape, x) : gamma_q(shape, x);
    const bool too_large = lower ? value > tail : value < tail;
    (too_large ? high : low) = y;
    if (value <= 0) {
      y = 0.5 * (low + high);
      continue;
    }
    // d ln P / dy = x^a e^{-x} / (Gamma(a) P), and the same with the other sign for Q.
    const double slope = front_factor(shape, x) / value * (lower ? 1 : -1);
    const double step = std::log(tail / value) / slope;
    const double next = y + step;
    if (std::abs(step) < 1e-13 * std::max(1.0, std::abs(y))) break;
    y = next > low && next < high ? next : 0.5 * (low + high);
  }
  return std::exp(y) / shape;
}

}  // namespace seaglint

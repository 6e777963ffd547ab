// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/strip_theory/exponential_integral.h"

#include <cmath>
#include <numbers>

namespace seaglint {

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

}  // namespace seaglint

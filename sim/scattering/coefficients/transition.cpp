// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/transition.h"

#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

constexpr Complex j(0, 1);

// Relative difference |x - y| / |x + y| below which arguments count as equal.
constexpr double kEqual = 1e-3;

bool nearly_equal(double x, double y) { return std::abs(x - y) < kEqual * std::abs(x + y); }

// Double transition function of (x, y), F(x) and F(y) given.
Complex divided_difference(double x, const Complex& F_x, double y, const Complex& F_y) {
  // Equal arguments: F - x F' with F' = F / 2x + j F - j. Unequal ones magnify errors of F at most five-hundredfold.
  if (nearly_equal(x, y)) {
    const double mean = 0.5 * (x + y);
    const Complex F = transition_function(mean);
    return 0.5 * F - j * mean * (F - 1.0);
  }
  return (y * F_x - x * F_y) / (y - x);
}

}  // namespace

Complex transition_function(double x) {
  if (x < 0) return std::conj(transition_function(-x));
  // Large x: asymptotic series, sum of (2n - 1)!! (j / 2x)^n, to its smallest term, about e^{-x}, which bounds the
  // error.
  if (x > 17) {
    double term = 1;
    std::array<double, 2> part{term, 0};
    for (int n = 1; n < x && term > 1e-16; ++n) {
      term *= (2.0 * n - 1) / (2 * x);
      part[n % 2] += n % 4 >= 2 ? -term : term;
    }
    return {part[0], part[1]};
  }
  // Small x: power series of the integral from 0 to sqrt(x), sum of (-j)^n x^(n + 1/2) / (n! (2n + 1)); its rounding
  // error is that of the largest term, e^x. Terms of both series are alternately real and imaginary; these decrease
  // from n = x on.
  double term = std::sqrt(x);
  std::array<double, 2> part{term, 0};
  for (int n = 1; n < 80 && term > 1e-18; ++n) {
    term *= x / n;
    part[n % 2] += (n % 4 == 1 || n % 4 == 2 ? -term : term) / (2.0 * n + 1);
  }
  const Complex sum(part[0], part[1]);
  return 2.0 * j * std::sqrt(x) * std::polar(1.0, x) * (std::polar(std::sqrt(kPi) / 2, -kPi / 4) - sum);
}

Complex double_transition_function(double x, double y) {
  return divided_difference(x, transition_function(x), y, transition_function(y));
}

Complex triple_transition_function(double x, double y, double z) {
  if (nearly_equal(x, y)) {  // moved apart; the error is of second order in kEqual
    const double mean = 0.5 * (x + y);
    x = (1 - kEqual) * mean;
    y = (1 + kEqual) * mean;
  }
  const Complex F_x = transition_function(x), F_y = transition_function(y), F_z = transition_function(z);
  return (y * divided_difference(x, F_x, z, F_z) - x * divided_difference(y, F_y, z, F_z)) / (y - x);
}

}  // namespace seaglint

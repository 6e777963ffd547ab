// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Integrals of smooth functions.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

}  // namespace seaglint

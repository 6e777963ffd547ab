// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace seaglint {

// (e^{jx} - 1)/(jx) e^{-jx/2} = sin(x/2)/(x/2), to rounding; by its power series for |x| < 1.
inline double half_argument_sinc(double x) {
  const double half = 0.5 * x, y = half * half;
  if (y >= 0.25) return std::sin(half) / half;
  return 1 - y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110 * (1 - y / 156)))));
}

}  // namespace seaglint

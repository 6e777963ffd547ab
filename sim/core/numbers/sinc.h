// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace seaglint {

// (e^{jx} - 1)/(jx) e^{-jx/2} = sin(x/2)/(x/2)
inline double half_argument_sinc(double x) {
  const double half = 0.5 * x;
  return std::abs(half) < 1e-4 ? 1 - half * half / 6 : std::sin(half) / half;
}

}  // namespace seaglint

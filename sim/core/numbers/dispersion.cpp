// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/dispersion.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"

namespace seaglint {

// Newton's method on x tanh x = w^2 h / g, x = k h, started between the deep and the shallow limit. The function is
// convex there, so that a few steps converge to rounding.
double wavenumber_at(double omega, double depth) {
  SEAGLINT_CHECK(omega >= 0 && depth > 0, fmt::format("omega = {} rad/s, depth = {} m", omega, depth));
  const double deep = omega * omega / kGravity;
  if (std::isinf(depth) || deep == 0) return deep;
  const double a = deep * depth;
  double x = a / std::sqrt(reproducible_tanh(a));
  constexpr int kMaxSteps = 20;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double t = reproducible_tanh(x);
    const double step = (x * t - a) / (t + x * (1 - t * t));
    x -= step;
    if (std::abs(step) <= 1e-16 * x) break;
  }
  return x / depth;
}

double breaking_height(double omega, double depth) {
  const double k = wavenumber_at(omega, depth);
  return 2 * kPi / k / 7 * (std::isinf(depth) ? 1 : reproducible_tanh(k * depth));
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/reproducible_functions.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// ln 2 in two parts: the product of an exponent below 2^11 with the first is exact.
constexpr double kLn2High = 0x1.62e42fefa3800p-1;
constexpr double kLn2Low = 0x1.ef35793c76730p-45;

}  // namespace

// x = m 2^e with m in [sqrt(1/2), sqrt(2)); ln m = 2 atanh s, s = (m-1)/(m+1), |s| < 0.172: error 1e-21 with thirteen
// terms.
double reproducible_log(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752440) {
    m *= 2;
    --exponent;
  }
  const double s = (m - 1) / (m + 1);
  const double s2 = s * s;
  double series = 0;
  for (int k = 12; k >= 0; --k) series = series * s2 + 1.0 / (2 * k + 1);
  return exponent * kLn2High + (2 * s * series + exponent * kLn2Low);
}

// x = n ln 2 + r, |r| <= ln(2)/2: the first neglected term of e^r is 1e-19.
double reproducible_exp(double x) {
  SEAGLINT_CHECK(x < 700, fmt::format("x = {}", x));
  if (x < -700) return 0;
  const double n = std::nearbyint(x / (kLn2High + kLn2Low));
  const double r = (x - n * kLn2High) - n * kLn2Low;
  constexpr double kInverseFactorial[] = {1,
                                          1,
                                          1.0 / 2,
                                          1.0 / 6,
                                          1.0 / 24,
                                          1.0 / 120,
                                          1.0 / 720,
                                          1.0 / 5040,
                                          1.0 / 40320,
                                          1.0 / 362880,
                                          1.0 / 3628800,
                                          1.0 / 39916800,
                                          1.0 / 479001600,
                                          1.0 / 6227020800,
                                          1.0 / 87178291200};
  double series = 0;
  for (int k = 14; k >= 0; --k) series = series * r + kInverseFactorial[k];
  return std::ldexp(series, static_cast<int>(n));
}

// Lambert's continued fraction x/(1 + x^2/(3 + x^2/(5 + ...))) where e^-2x would cancel.
double reproducible_tanh(double x) {
  if (std::abs(x) < 1) {
    double fraction = 21;
    for (int k = 19; k >= 1; k -= 2) fraction = k + x * x / fraction;
    return x / fraction;
  }
  const double e = std::abs(x) > 350 ? 0 : reproducible_exp(-2 * std::abs(x));
  return std::copysign((1 - e) / (1 + e), x);
}

}  // namespace seaglint

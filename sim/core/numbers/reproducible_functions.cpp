// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/reproducible_functions.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
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

namespace {

// pi in three parts (Cody and Waite 1980, chapter 8): a product of the first two, of 26 significant bits each, with an
// integer below 2^27 is exact.
constexpr double kPi1 = 0x1.921fb58p+1;
constexpr double kPi2 = -0x1.dde974p-26;
constexpr double kPi3 = 0x1.1a62633145c07p-53;
constexpr double kInversePi = 0x1.45f306dc9c883p-2;
constexpr double kRoundToInteger = 0x1.8p52;  // adding and subtracting it rounds to the nearest integer

}  // namespace

// theta = n pi + r with |r| <= pi/2; cos theta = (-1)^n cos r and sin theta = (-1)^n sin r, by their Taylor series: the
// first neglected terms are below 1e-18. Branch- and table-free, so that compilers vectorise it.
void unit_phasors(std::span<const double> angle, std::span<double> cosine, std::span<double> sine) {
  const std::size_t count = angle.size();
  SEAGLINT_CHECK(cosine.size() == count && sine.size() == count, "spans of different lengths");
  const double* theta = angle.data();
  double* c = cosine.data();
  double* s = sine.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double n = (theta[i] * kInversePi + kRoundToInteger) - kRoundToInteger;
    const double half = (0.5 * n + kRoundToInteger) - kRoundToInteger;
    const double odd = n - 2 * half;  // -1, 0 or 1
    const double sign = 1 - 2 * odd * odd;
    const double r = ((theta[i] - n * kPi1) - n * kPi2) - n * kPi3;
    const double x = r * r;
    double p = 1.0 / 51090942171709440000.0;  // sin r = r - r^3/3! + ... + r^21/21!
    p = p * x - 1.0 / 121645100408832000.0;
    p = p * x + 1.0 / 355687428096000.0;
    p = p * x - 1.0 / 1307674368000.0;
    p = p * x + 1.0 / 6227020800.0;
    p = p * x - 1.0 / 39916800.0;
    p = p * x + 1.0 / 362880.0;
    p = p * x - 1.0 / 5040.0;
    p = p * x + 1.0 / 120.0;
    p = p * x - 1.0 / 6.0;
    double q = -1.0 / 1124000727777607680000.0;  // cos r = 1 - r^2/2! + ... - r^22/22!
    q = q * x + 1.0 / 2432902008176640000.0;
    q = q * x - 1.0 / 6402373705728000.0;
    q = q * x + 1.0 / 20922789888000.0;
    q = q * x - 1.0 / 87178291200.0;
    q = q * x + 1.0 / 479001600.0;
    q = q * x - 1.0 / 3628800.0;
    q = q * x + 1.0 / 40320.0;
    q = q * x - 1.0 / 720.0;
    q = q * x + 1.0 / 24.0;
    q = q * x - 0.5;
    s[i] = sign * (r + r * x * p);
    c[i] = sign * (1 + x * q);
  }
}

double wrapped_angle(double angle) {
  if (std::abs(angle) <= kLargestAngle) return angle;
  SEAGLINT_CHECK(std::abs(angle) <= 1e12, fmt::format("phase of a wave {} rad", angle));
  return std::remainder(angle, 2 * kPi);
}

UniformPhasors::UniformPhasors(std::vector<double> omega, std::vector<double> phase, double start, double step)
    : omega_(std::move(omega)), phase_(std::move(phase)), start_(start), step_(step) {
  const std::size_t count = omega_.size();
  SEAGLINT_CHECK(phase_.size() == count, "as many phases as frequencies");
  turn_cosine_.resize(count);
  turn_sine_.resize(count);
  cosine_.resize(count);
  sine_.resize(count);
  angle_.resize(count);
  for (std::size_t i = 0; i < count; ++i) angle_[i] = omega_[i] * step_;
  unit_phasors(angle_, turn_cosine_, turn_sine_);
  synchronise();
}

void UniformPhasors::synchronise() {
  const double t = time();
  for (std::size_t i = 0; i < omega_.size(); ++i) angle_[i] = wrapped_angle(omega_[i] * t + phase_[i]);
  unit_phasors(angle_, cosine_, sine_);
}

void UniformPhasors::advance() {
  ++count_;
  if (count_ % kResynchronise == 0) {
    synchronise();
    return;
  }
  double* c = cosine_.data();
  double* s = sine_.data();
  const double* tc = turn_cosine_.data();
  const double* ts = turn_sine_.data();
  for (std::size_t i = 0; i < omega_.size(); ++i) {
    const double rotated = c[i] * tc[i] - s[i] * ts[i];
    s[i] = s[i] * tc[i] + c[i] * ts[i];
    c[i] = rotated;
  }
}

}  // namespace seaglint

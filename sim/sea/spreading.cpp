// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/spreading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/quadrature.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/numbers/unit_phasors.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// cos^2s(x), |x| <= pi/2.
double cosine_power(double x, double s) {
  double cosine = 1, sine = 0;
  unit_phasors({&x, 1}, {&cosine, 1}, {&sine, 1});
  return cosine > 0 ? reproducible_exp(2 * s * reproducible_log(cosine)) : 0;
}

// Integral of cos^2s over [0, pi/2], bit-identical on all machines. With x = pi/2 - y^4 the integrand has no steep end
// for small s.
double quarter_norm(double s, double piece) {
  const double end = std::sqrt(std::sqrt(kPi / 2));
  return integrate(0, end, piece / 6, [s](double y) {
    const double y3 = y * y * y;
    return cosine_power(kPi / 2 - y3 * y, s) * 4 * y3;
  });
}

}  // namespace

double spreading_exponent(const SpreadingSpec& spec, double omega_over_peak) {
  if (spec.kind != Spreading::kMitsuyasu) return spec.s;
  return spec.s * reproducible_exp((omega_over_peak <= 1 ? 5 : -2.5) * reproducible_log(omega_over_peak));
}

double spreading_quantile(const SpreadingSpec& spec, double probability, double omega_over_peak) {
  SEAGLINT_CHECK(probability > 0 && probability < 1, fmt::format("probability {}", probability));
  if (spec.kind == Spreading::kNone) return 0;
  if (spec.kind == Spreading::kWrappedNormal) return radians(spec.width_deg) * normal_quantile(probability);

  // With x = angle/2, the probability of [0, x] is I(x)/(2 I(pi/2)), I the integral of cos^2s. It is concave, so that
  // Newton's method from 0 converges monotonically.
  const double s = spreading_exponent(spec, omega_over_peak);
  const auto power = [s](double x) { return cosine_power(x, s); };
  const double piece = std::min(0.1, 0.5 / std::sqrt(s));  // a fraction of the width of cos^2s
  const double target = std::abs(2 * probability - 1) * quarter_norm(s, piece);
  double x = 0, reached = 0;
  constexpr int kMaxSteps = 200;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double next = std::min(x + (target - reached) / power(x), kPi / 2);
    if (!(next - x > 1e-11)) break;
    reached += integrate(x, next, piece, power);
    x = next;
  }
  return std::copysign(2 * x, probability - 0.5);
}

}  // namespace seaglint

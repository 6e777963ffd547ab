// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/jonswap.h"

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/reproducible_functions.h"

namespace seaglint {
namespace {

// Integral of u^(n-5) exp(-1.25 u^-4) (1 + enhancement). Without the enhancement it is 1.25^(n/4-1) Gamma(1 - n/4) / 4;
// `gamma_function` is that Gamma.
double moment(int n, double gamma_function, double gamma) {
  const auto enhanced = [&](double u) {
    const double u4 = u * u * u * u;
    const double power = n < 0 ? 1 / (u4 * u * u) : n == 0 ? 1 / (u4 * u) : 1 / (u * u * u);
    return power * reproducible_exp(-1.25 / u4) * jonswap_enhancement(u, gamma);
  };
  constexpr double kPiece = 0.02;
  return 0.25 * gamma_function * reproducible_exp((0.25 * n - 1) * reproducible_log(1.25)) +
         integrate(kEnhancementBegin, 1, kPiece, enhanced) + integrate(1, kEnhancementEnd, kPiece, enhanced);
}

double zeroth_moment(double gamma) { return moment(0, 1, gamma); }

}  // namespace

double jonswap_enhancement(double u, double gamma) {
  const double s = u <= 1 ? 0.07 : 0.09;
  const double z = (u - 1) / s;
  return reproducible_exp(reproducible_log(gamma) * reproducible_exp(-0.5 * z * z)) - 1;
}

double energy_period_ratio(double gamma) {
  constexpr double kGammaOfFiveQuarters = 0.90640247705547707798;
  return moment(-1, kGammaOfFiveQuarters, gamma) / zeroth_moment(gamma);
}

double zero_crossing_period_ratio(double gamma) {
  return std::sqrt(zeroth_moment(gamma) / moment(2, std::sqrt(kPi), gamma));
}

}  // namespace seaglint

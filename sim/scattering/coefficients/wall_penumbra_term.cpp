// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/wall_penumbra_term.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/coefficients/transition.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"

namespace seaglint {
namespace {

constexpr double kMinLength = 1e-12;  // m; edge and foot may intersect
constexpr double kMinRun = 1e-3;      // smallest |run|, rad
constexpr double kFar = 1e15;         // bound of z where edge and foot are parallel
// Smallest sine evaluated: below it the cancelling terms lose their digits, and the value is extrapolated linearly.
constexpr double kMinSine = 1e-4;
// Step of s for the numerical derivative: the aspect change of one trace, rad.
constexpr double kTurn = 1e-3;

}  // namespace

Complex WallPenumbraTerm::at_sine(double s, double k, double fraction, double run) const {
  const double length = std::max(l[0] + fraction * (l[1] - l[0]), kMinLength), growth = l[1] - l[0],
               c = std::sqrt(1 - s * s);
  // A term whose phase is that of the foot less k decrement l, and so has its own run.
  const auto with_phase = [&](double decrement, const auto& amplitude) {
    const double lower = k * (decrement - psi_decrement), own = run - lower * growth;
    const double kept = std::abs(own) < kMinRun ? std::copysign(kMinRun, own) : own;
    return run / kept * amplitude(kept) * std::polar(1.0, -lower * length);
  };
  Complex sum = 0;
  const double at_end = 1 / (4 * kPi * std::abs(s));
  if (foot_weight != 0) sum += with_phase(0, [&](double) { return foot_weight * at_end; });
  if (shadow_line_weight != 0) sum += with_phase(2 * s * s / c, [&](double) { return shadow_line_weight * at_end; });
  if (edge_path_weight > 0) {
    sum -= with_phase(2 * (1 - c), [&](double own) {
      const double x = k * length * s * s, z = -std::clamp(own * length / growth, -kFar, kFar);
      const Complex hard = triple_transition_function(x, x, z);
      return edge_path_weight / (2 * kPi * s * s * std::sqrt(kPi * k * length)) * std::polar(1.0, -kPi / 4) *
             (soft ? double_transition_function(x, z) - hard : hard);
    });
  }
  return sum;
}

double WallPenumbraTerm::psi_spread() const {
  const double c = std::sqrt(1 - sine * sine);
  double spread = 0;
  const auto include = [&](double weight, double decrement) {
    if (weight != 0) spread = std::max(spread, std::abs(decrement - psi_decrement));
  };
  include(foot_weight, 0);
  include(shadow_line_weight, 2 * sine * sine / c);
  include(edge_path_weight, 2 * (1 - c));
  return spread * std::max(l[0], l[1]);
}

Complex WallPenumbraTerm::at(double k, double fraction, double run) const {
  if (part == Part::kComplete) return at_sine(sine, k, fraction, run);
  const double side = std::copysign(1.0, sine), near = std::abs(sine);
  const double min = std::max(near - kTurn, kMinSine), max = near + kTurn;
  const Complex change =
      (at_sine(side * max, k, fraction, run) - at_sine(side * min, k, fraction, run)) / (side * (max - min));
  const Complex of_change = change / Complex(0, k * derivative_scale_m);
  if (part == Part::kDerivative) return of_change;
  const double here = std::max(near, kMinSine);
  return at_sine(side * here, k, fraction, run) + side * (near - here) * change - of_change;
}

}  // namespace seaglint

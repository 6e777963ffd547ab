// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/amplitude_laws.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"

namespace seaglint {

namespace {

// Relative difference |x - y| / |x + y| below which arguments count as equal.
constexpr double kEqual = 1e-3;

bool nearly_equal(double x, double y) { return std::abs(x - y) < kEqual * std::abs(x + y); }

// Double transition function of (x, y), F(x) and F(y) given.
Complex divided_difference(double x, const Complex& F_x, double y, const Complex& F_y) {
  // Equal arguments: F - x F' with F' = F / 2x + j F - j. Unequal ones magnify errors of F at most five-hundredfold.
  if (nearly_equal(x, y)) {
    const double mean = 0.5 * (x + y);
    const Complex F = transition_function(mean);
    return 0.5 * F - kJ * mean * (F - 1.0);
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
  return 2.0 * kJ * std::sqrt(x) * std::polar(1.0, x) * (std::polar(std::sqrt(kPi) / 2, -kPi / 4) - sum);
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

Complex GrazingWaveAmplitude::at(double k, double fraction, double run) const {
  constexpr double kMinLength = 1e-12;  // m: at a vertex, where both edges meet, the product with the decay is finite
  constexpr double kFar = 1e15;         // parallel edges
  const double length = std::max(interpolate(l, fraction), kMinLength);
  const double phase = std::clamp(run * length / (l[1] - l[0]), -kFar, kFar);
  Complex boundaries =
      triple_transition_function(2 * k * launch_parameter * length, 2 * k * exit_parameter * length, -phase);
  for (int wave = 0; wave + 1 < grazing_waves; ++wave) boundaries *= transition_function(k * detour_m[wave]);
  return boundaries * std::pow(k, -0.5 * grazing_waves) / std::sqrt(length);
}

namespace {

// Phase over an interval from which on its end points suffice, rad; phase per part of the quadrature.
constexpr double kFast = 60, kPartPhase = 3;

// F(u^2) / u, u of either sign.
Complex transition_over_root(double u) {
  constexpr double kAtBoundary = 1e-6;
  return std::abs(u) < kAtBoundary ? std::copysign(std::sqrt(kPi), u) * std::polar(1.0, kPi / 4)
                                   : transition_function(u * u) / u;
}
double bound_of_over_root(double u) { return std::min(std::sqrt(kPi), 1 / u); }

}  // namespace

double DoubleKnifeEdge::axial_taper(double k, double distance_m) const {
  return smooth_taper(0.5 * k * distance_m * psi_slope * psi_slope, kAxialPhaseWindow);
}

Complex DoubleKnifeEdge::off_axis_width(double k, double fraction) const {
  constexpr double kEqual = 0.05;  // below it by the derivative of F(u^2) / u, 2j (F - 1)
  const double past = interpolate(exit_excess, fraction);
  const double u = (second_in_shadow ? 1 : -1) * std::sqrt(k * interpolate(excess_path, fraction)),
               v = std::copysign(std::sqrt(k * std::abs(past)), past);
  if (u * v >= 0 && std::abs(u - v) < kEqual)
    return (u - v) / (std::sqrt(kPi) * psi_slope) * (1.0 - transition_function(u * v));
  return Complex(0, 1 / (2 * std::sqrt(kPi) * psi_slope)) * (transition_over_root(u) - transition_over_root(v));
}

Complex DoubleKnifeEdge::at(double k, double fraction, double run) const {
  const double d = interpolate(separation, fraction);
  Complex sum = off_axis_weight > 0 ? off_axis_weight * off_axis_width(k, fraction) : 0;
  if (axial_weight > 0) {
    // End-point term with a phase a per fraction t: the integral of sqrt(t) e^{jat} from 0 on is (j / a) sqrt(pi j /
    // 4a), that of sqrt(d + t) to first order (j / a) sqrt(d + j / a).
    const Complex reached = d + (separation[1] - separation[0]) * Complex(0, kPi / 4 / run);
    sum += axial_weight * axial_taper(k, d) * std::sqrt(k / (2 * kPi) * reached) *
           (1.0 - transition_function(k * interpolate(excess_path, fraction)));
  }
  return std::polar(1.0, -kPi / 4) * sum;
}

bool DoubleKnifeEdge::endpoints_suffice(double phase) { return std::abs(phase) >= kFast; }

Complex DoubleKnifeEdge::mean(double k, double phase, double from, double to) const {
  constexpr std::array<double, 4> node{-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053},
      weight{0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454};
  const int parts = 1 + static_cast<int>(std::abs(phase) / kPartPhase);
  Complex sum = 0;
  for (int part = 0; part < parts; ++part) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const double place = (part + 0.5 * (1 + node[i])) / parts;
      sum += 0.5 * weight[i] * at(k, from + place * (to - from)) * std::polar(1.0, (place - 0.5) * phase);
    }
  }
  return sum / static_cast<double>(parts);
}

double DoubleKnifeEdge::upper_bound(double lowest) const {
  const auto [nearest, farthest] = std::minmax(separation[0], separation[1]);
  const double shortest = std::min(excess_path[0], excess_path[1]),
               past = exit_excess[0] * exit_excess[1] > 0 ? std::min(std::abs(exit_excess[0]), std::abs(exit_excess[1]))
                                                          : 0.0;
  double bound = 0;
  if (off_axis_weight > 0)
    bound += off_axis_weight / (2 * std::sqrt(kPi) * std::abs(psi_slope)) *
             (bound_of_over_root(std::sqrt(lowest * shortest)) + bound_of_over_root(std::sqrt(lowest * past)));
  // |1 - F(x)| is at most 1 and at most 1 / 2x.
  if (axial_weight > 0)
    bound += axial_weight * axial_taper(lowest, nearest) * std::sqrt(lowest * farthest / (2 * kPi)) *
             std::min(1.0, 0.5 / (lowest * shortest));
  return bound;
}

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

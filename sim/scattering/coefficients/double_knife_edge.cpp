// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/double_knife_edge.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/transition.h"

namespace seaglint {
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

}  // namespace seaglint

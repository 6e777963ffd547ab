// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/edge_contribution.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/sinc.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/diffraction/transition.h"
#include "sim/scattering/diffraction/wedge_diffraction.h"

namespace seaglint {

std::array<Complex, 4> EdgePattern::at(double k) const {
  std::array<Complex, 4> all = thin;
  if (thickness_m > 0) {
    const double kt = k * thickness_m, logarithm = std::log(kt);
    for (int i = 0; i < 4; ++i) all[i] += kt * (thickness_linear[i] + logarithm * thickness_log[i]);
  }
  return all;
}

EdgePattern& EdgePattern::operator+=(const EdgePattern& other) {
  for (int i = 0; i < 4; ++i) {
    thin[i] += other.thin[i];
    thickness_linear[i] += other.thickness_linear[i];
    thickness_log[i] += other.thickness_log[i];
  }
  return *this;
}

EdgePattern& EdgePattern::operator*=(double factor) {
  for (auto* part : {&thin, &thickness_linear, &thickness_log}) {
    for (Complex& element : *part) element *= factor;
  }
  return *this;
}

EdgePattern transposed(EdgePattern pattern) {
  for (auto* part : {&pattern.thin, &pattern.thickness_linear, &pattern.thickness_log})
    std::swap((*part)[1], (*part)[2]);
  return pattern;
}

namespace {

// Phase over an interval of double knife-edge diffraction above which its end points suffice, rad; phase per part of
// the numerical integral below.
constexpr double kFast = 60, kPartPhase = 3;

// k (psi_1 - psi_0), kept away from 0, where the end-point terms are infinite: changes the integral by at most this
// fraction.
double phase_difference(const EdgeContribution& contribution, double k) {
  constexpr double kMin = 1e-3;  // rad
  const double run = k * (contribution.psi[1] - contribution.psi[0]);
  return std::abs(run) < kMin ? std::copysign(kMin, run) : run;
}

// Factor of the amplitude law at a fraction of the interval.
Complex multiple_diffraction_factor(const EdgeContribution::MultipleDiffraction& range, double k, double run,
                                    double share) {
  constexpr double kMinLength = 1e-12;  // m: at a vertex, where both edges meet, the product with the decay is finite
  constexpr double kFar = 1e15;         // parallel edges
  const double l = std::max(interpolate(range.l, share), kMinLength);
  const double phase = std::clamp(run * l / (range.l[1] - range.l[0]), -kFar, kFar);
  const double x = 2 * k * range.launch_parameter * (range.grazing_waves == 1 ? l : range.first_length_m),
               y = 2 * k * range.exit_parameter * l;
  const Complex boundaries = range.grazing_waves == 1 ? triple_transition_function(x, y, -phase)
                                                      : transition_function(x) * double_transition_function(y, -phase);
  return boundaries * std::pow(k, -0.5 * range.grazing_waves) / std::sqrt(l);
}

// Mean of width e^{j phase (fraction - middle)} over a part of an interval: Gauss-Legendre quadrature with four points
// per three radians, since the width varies as the square root of the distance between edges that meet.
Complex mean_width(const EdgeContribution::DoubleKnifeEdge& knives, double k, double phase, double from, double to) {
  constexpr std::array<double, 4> node{-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053},
      weight{0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454};
  const int parts = 1 + static_cast<int>(std::abs(phase) / kPartPhase);
  Complex sum = 0;
  for (int part = 0; part < parts; ++part) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const double place = (part + 0.5 * (1 + node[i])) / parts;
      sum += 0.5 * weight[i] * knives.effective_width(k, from + place * (to - from)) *
             std::polar(1.0, (place - 0.5) * phase);
    }
  }
  return sum / static_cast<double>(parts);
}

// Factor of the amplitude law, 1 for single diffraction.
Complex amplitude_at(const EdgeContribution& contribution, double k, double run, double share) {
  if (contribution.multiple_diffraction)
    return multiple_diffraction_factor(*contribution.multiple_diffraction, k, run, share);
  if (contribution.penumbra) return contribution.penumbra->at(k, share, run);
  return contribution.double_knife_edge ? contribution.double_knife_edge->effective_width(k, share, run) : 1.0;
}

}  // namespace

double EdgeContribution::DoubleKnifeEdge::axial_taper(double k, double distance_m) const {
  return smooth_taper(0.5 * k * distance_m * psi_slope * psi_slope, {0, 1});
}

double EdgeContribution::fresnel_taper(double k) const { return smooth_taper(fresnel_wavenumber / k, {1, 2.5}); }

namespace {

// F(u^2) / u, u of either sign.
Complex transition_over_root(double u) {
  constexpr double kAtBoundary = 1e-6;
  return std::abs(u) < kAtBoundary ? std::polar(std::copysign(std::sqrt(kPi), u), kPi / 4)
                                   : transition_function(u * u) / u;
}
double bound_of_over_root(double u) { return std::min(std::sqrt(kPi), 1 / u); }

}  // namespace

Complex EdgeContribution::DoubleKnifeEdge::off_axis_width(double k, double share) const {
  constexpr double kEqual = 0.05;  // below it by the derivative of F(u^2) / u, 2j (F - 1)
  const double past = interpolate(exit_excess, share);
  const double u = (second_in_shadow ? 1 : -1) * std::sqrt(k * interpolate(excess_path, share)),
               v = std::copysign(std::sqrt(k * std::abs(past)), past);
  if (u * v >= 0 && std::abs(u - v) < kEqual)
    return (u - v) / (std::sqrt(kPi) * psi_slope) * (1.0 - transition_function(u * v));
  return Complex(0, 1 / (2 * std::sqrt(kPi) * psi_slope)) * (transition_over_root(u) - transition_over_root(v));
}

Complex EdgeContribution::DoubleKnifeEdge::effective_width(double k, double share, double run) const {
  const double d = interpolate(separation, share);
  Complex sum = off_axis_weight > 0 ? off_axis_weight * off_axis_width(k, share) : 0;
  if (axial_weight > 0) {
    // End-point term with a phase a per fraction t: the integral of sqrt(t) e^{jat} from 0 on is (j / a) sqrt(pi j /
    // 4a), that of sqrt(d + t) to first order (j / a) sqrt(d + j / a).
    const Complex reached = d + (separation[1] - separation[0]) * Complex(0, kPi / 4 / run);
    sum += axial_weight * axial_taper(k, d) * std::sqrt(k / (2 * kPi) * reached) *
           (1.0 - transition_function(k * interpolate(excess_path, share)));
  }
  return std::polar(1.0, -kPi / 4) * sum;
}

double EdgeContribution::DoubleKnifeEdge::upper_bound(double lowest) const {
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

Complex endpoint_term(const EdgeContribution& contribution, double k, double share) {
  const double run = phase_difference(contribution, k);
  return contribution.fresnel_taper(k) * contribution.length / Complex(0, run) *
         amplitude_at(contribution, k, run, share);
}

bool endpoints_suffice(const EdgeContribution& contribution, double k) {
  return !contribution.double_knife_edge || k * std::abs(contribution.psi[1] - contribution.psi[0]) >= kFast;
}

Complex interval_integral(const EdgeContribution& contribution, double k, double from, double to) {
  const double phase = k * (contribution.psi[1] - contribution.psi[0]) * (to - from);
  const double length = contribution.fresnel_taper(k) * contribution.length * (to - from);
  if (!contribution.multiple_diffraction && !contribution.double_knife_edge && !contribution.penumbra)
    return length * half_argument_sinc(phase);
  if (contribution.double_knife_edge && std::abs(phase) < kFast)
    return length * mean_width(*contribution.double_knife_edge, k, phase, from, to);
  const Complex half = std::polar(1.0, 0.5 * (to - from) * phase_difference(contribution, k));
  return endpoint_term(contribution, k, to) * half - endpoint_term(contribution, k, from) * std::conj(half);
}

std::array<Complex, 4> scattered(const EdgeContribution& contribution, double k) {
  const Complex integral =
      interval_integral(contribution, k, 0, 1) * std::polar(1.0, k * 0.5 * (contribution.psi[0] + contribution.psi[1]));
  std::array<Complex, 4> s = contribution.pattern.at(k);
  for (Complex& element : s) element *= integral;
  return s;
}

}  // namespace seaglint

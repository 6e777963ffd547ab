// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/edge_contribution.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/diffraction/wedge_diffraction.h"

namespace seaglint {

std::array<Complex, 4> EdgePattern::at(double k) const {
  std::array<Complex, 4> all = sharp;
  if (thickness_m > 0) {
    const double kt = k * thickness_m, logarithm = std::log(kt);
    for (int i = 0; i < 4; ++i) all[i] += kt * (thick[i] + logarithm * thick_log[i]);
  }
  return all;
}

EdgePattern& EdgePattern::operator+=(const EdgePattern& other) {
  for (int i = 0; i < 4; ++i) {
    sharp[i] += other.sharp[i];
    thick[i] += other.thick[i];
    thick_log[i] += other.thick_log[i];
  }
  return *this;
}

EdgePattern& EdgePattern::operator*=(double factor) {
  for (auto* part : {&sharp, &thick, &thick_log}) {
    for (Complex& element : *part) element *= factor;
  }
  return *this;
}

EdgePattern transposed(EdgePattern pattern) {
  for (auto* part : {&pattern.sharp, &pattern.thick, &pattern.thick_log}) std::swap((*part)[1], (*part)[2]);
  return pattern;
}

namespace {

// Phase along a stretch between knife edges from which on its ends answer alone, rad, and along each part of a slower
// one, that is summed.
constexpr double kFast = 60, kPartPhase = 3;

// k (psi_1 - psi_0), kept from 0, where the terms of both ends would be infinite: moves the integral by a part of this
// at most.
double phase_run(const EdgeFootprint& footprint, double k) {
  constexpr double kLeast = 1e-3;  // rad
  const double run = k * (footprint.psi[1] - footprint.psi[0]);
  return std::abs(run) < kLeast ? std::copysign(kLeast, run) : run;
}

// What the range makes of the pattern at one end of a part of the stretch.
Complex range_at(const EdgeFootprint::EdgeWaveRange& range, double k, double run, double share) {
  constexpr double kLeastLength = 1e-12;  // m: in a corner, where both edges meet, the product with the decay is finite
  constexpr double kFar = 1e15;           // parallel edges
  const double l = std::max(at_share(range.l, share), kLeastLength);
  const double phase = std::clamp(run * l / (range.l[1] - range.l[0]), -kFar, kFar);
  const double x = 2 * k * range.departure * (range.waves == 1 ? l : range.first_m), y = 2 * k * range.arrival * l;
  const Complex boundaries = range.waves == 1 ? transition(x, y, -phase) : transition(x) * transition(y, -phase);
  return boundaries * std::pow(k, -0.5 * range.waves) / std::sqrt(l);
}

// Mean of width e^{j phase (share - middle)} over a part of a stretch: Gauss and Legendre's four points for each three
// radians, since the width goes with the root of the way between rims that meet.
Complex mean_width(const EdgeFootprint::KnifeEdges& knives, double k, double phase, double from, double to) {
  constexpr std::array<double, 4> node{-0.861136311594053, -0.339981043584856, 0.339981043584856, 0.861136311594053},
      weight{0.347854845137454, 0.652145154862546, 0.652145154862546, 0.347854845137454};
  const int parts = 1 + static_cast<int>(std::abs(phase) / kPartPhase);
  Complex sum = 0;
  for (int part = 0; part < parts; ++part) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      const double place = (part + 0.5 * (1 + node[i])) / parts;
      sum += 0.5 * weight[i] * knives.width(k, from + place * (to - from)) * std::polar(1.0, (place - 0.5) * phase);
    }
  }
  return sum / static_cast<double>(parts);
}

// What a range, a wall or knife edges make of the pattern there.
Complex amplitude_at(const EdgeFootprint& footprint, double k, double run, double share) {
  if (footprint.edge_wave) return range_at(*footprint.edge_wave, k, run, share);
  if (footprint.wall) return footprint.wall->at(k, share, run);
  return footprint.knife_edges ? footprint.knife_edges->width(k, share, run) : 1.0;
}

}  // namespace

double EdgeFootprint::KnifeEdges::fade_by_slope(double k, double distance_m) const {
  return fading(0.5 * k * distance_m * slope * slope, {0, 1});
}

double EdgeFootprint::fade_by_spread(double k) const { return fading(spread / k, {1, 2.5}); }

namespace {

// F(u^2) / u, u of either sign.
Complex over_root(double u) {
  constexpr double kAtBoundary = 1e-6;
  return std::abs(u) < kAtBoundary ? std::polar(std::copysign(std::sqrt(kPi), u), kPi / 4) : transition(u * u) / u;
}
double bound_of_over_root(double u) { return std::min(std::sqrt(kPi), 1 / u); }

}  // namespace

Complex EdgeFootprint::KnifeEdges::sloping(double k, double share) const {
  constexpr double kEqual = 0.05;  // below it the difference is that of F(u^2) / u, 2j (F - 1), to its square
  const double past = at_share(beyond, share);
  const double u = (shadow_within ? 1 : -1) * std::sqrt(k * at_share(excess, share)),
               v = std::copysign(std::sqrt(k * std::abs(past)), past);
  if (u * v >= 0 && std::abs(u - v) < kEqual) return (u - v) / (std::sqrt(kPi) * slope) * (1.0 - transition(u * v));
  return Complex(0, 1 / (2 * std::sqrt(kPi) * slope)) * (over_root(u) - over_root(v));
}

Complex EdgeFootprint::KnifeEdges::width(double k, double share, double run) const {
  const double d = at_share(distance, share);
  Complex sum = moved > 0 ? moved * sloping(k, share) : 0;
  if (still > 0) {
    // An end of running phase a along a root: the integral of sqrt(t) e^{jat} from 0 on is (j / a) sqrt(pi j / 4a),
    // that of sqrt(d + t) to first order (j / a) sqrt(d + j / a).
    const Complex reached = d + (distance[1] - distance[0]) * Complex(0, kPi / 4 / run);
    sum += still * fade_by_slope(k, d) * std::sqrt(k / (2 * kPi) * reached) *
           (1.0 - transition(k * at_share(excess, share)));
  }
  return std::polar(1.0, -kPi / 4) * sum;
}

double EdgeFootprint::KnifeEdges::bound(double lowest) const {
  const auto [nearest, farthest] = std::minmax(distance[0], distance[1]);
  const double shortest = std::min(excess[0], excess[1]),
               past = beyond[0] * beyond[1] > 0 ? std::min(std::abs(beyond[0]), std::abs(beyond[1])) : 0.0;
  double bound = 0;
  if (moved > 0)
    bound += moved / (2 * std::sqrt(kPi) * std::abs(slope)) *
             (bound_of_over_root(std::sqrt(lowest * shortest)) + bound_of_over_root(std::sqrt(lowest * past)));
  // |1 - F(x)| is at most 1 and at most 1 / 2x.
  if (still > 0)
    bound += still * fade_by_slope(lowest, nearest) * std::sqrt(lowest * farthest / (2 * kPi)) *
             std::min(1.0, 0.5 / (lowest * shortest));
  return bound;
}

Complex end_term(const EdgeFootprint& footprint, double k, double share) {
  const double run = phase_run(footprint, k);
  return footprint.fade_by_spread(k) * footprint.length / Complex(0, run) * amplitude_at(footprint, k, run, share);
}

bool ends_answer_alone(const EdgeFootprint& footprint, double k) {
  return !footprint.knife_edges || k * std::abs(footprint.psi[1] - footprint.psi[0]) >= kFast;
}

Complex part_integral(const EdgeFootprint& footprint, double k, double from, double to) {
  const double phase = k * (footprint.psi[1] - footprint.psi[0]) * (to - from);
  const double length = footprint.fade_by_spread(k) * footprint.length * (to - from);
  if (!footprint.edge_wave && !footprint.knife_edges && !footprint.wall) return length * sinc(phase);
  if (footprint.knife_edges && std::abs(phase) < kFast)
    return length * mean_width(*footprint.knife_edges, k, phase, from, to);
  const Complex half = std::polar(1.0, 0.5 * (to - from) * phase_run(footprint, k));
  return end_term(footprint, k, to) * half - end_term(footprint, k, from) * std::conj(half);
}

std::array<Complex, 4> scattered(const EdgeFootprint& footprint, double k) {
  const Complex integral =
      part_integral(footprint, k, 0, 1) * std::polar(1.0, k * 0.5 * (footprint.psi[0] + footprint.psi[1]));
  std::array<Complex, 4> s = footprint.pattern.at(k);
  for (Complex& element : s) element *= integral;
  return s;
}

}  // namespace seaglint

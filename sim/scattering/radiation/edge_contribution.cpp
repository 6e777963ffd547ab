// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/edge_contribution.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/core/numbers/sinc.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/coefficients/fade_windows.h"

namespace seaglint {
namespace {

std::array<Complex, 4> tabulated(const std::vector<EdgePattern::AtWavenumber>& table, double k) {
  const auto above =
      std::ranges::lower_bound(table, k, {}, [](const EdgePattern::AtWavenumber& entry) { return entry.k; });
  if (above == table.end()) return table.back().value;
  if (above == table.begin() || above->k == k) return above->value;
  const EdgePattern::AtWavenumber &a = *std::prev(above), &b = *above;
  const double share = (k - a.k) / (b.k - a.k);
  std::array<Complex, 4> value;
  for (int i = 0; i < 4; ++i) value[i] = a.value[i] + share * (b.value[i] - a.value[i]);
  return value;
}

}  // namespace

std::array<Complex, 4> EdgePattern::at(double k) const {
  if (!by_wavenumber.empty()) return tabulated(by_wavenumber, k);
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
  for (std::size_t q = 0; q < by_wavenumber.size(); ++q) {
    for (int i = 0; i < 4; ++i) by_wavenumber[q].value[i] += other.by_wavenumber[q].value[i];
  }
  return *this;
}

EdgePattern& EdgePattern::operator*=(double factor) {
  for (auto* part : {&thin, &thickness_linear, &thickness_log}) {
    for (Complex& element : *part) element *= factor;
  }
  for (AtWavenumber& entry : by_wavenumber) {
    for (Complex& element : entry.value) element *= factor;
  }
  return *this;
}

EdgePattern transposed(EdgePattern pattern) {
  for (auto* part : {&pattern.thin, &pattern.thickness_linear, &pattern.thickness_log})
    std::swap((*part)[1], (*part)[2]);
  for (EdgePattern::AtWavenumber& entry : pattern.by_wavenumber) std::swap(entry.value[1], entry.value[2]);
  return pattern;
}

EdgePattern reciprocal_mean(EdgePattern pattern, const EdgePattern& back) {
  pattern += transposed(back);
  pattern *= 0.5;
  return pattern;
}

namespace {

// k (psi_1 - psi_0), kept away from 0, where the end-point terms are infinite: changes the integral by at most this
// fraction.
double phase_difference(const EdgeContribution& contribution, double k) {
  constexpr double kMin = 1e-3;  // rad
  const double run = k * (contribution.psi[1] - contribution.psi[0]);
  return std::abs(run) < kMin ? std::copysign(kMin, run) : run;
}

}  // namespace

double EdgeContribution::fresnel_taper(double k) const {
  return smooth_taper(fresnel_wavenumber / k, kFresnelDepthWindow);
}

Complex endpoint_term(const EdgeContribution& contribution, double k, double fraction) {
  const double run = phase_difference(contribution, k);
  const auto at_fraction = [&](const auto& law) { return law.at(k, fraction, run); };
  return contribution.fresnel_taper(k) * contribution.length / Complex(0, run) *
         std::visit(at_fraction, contribution.amplitude);
}

bool endpoints_suffice(const EdgeContribution& contribution, double k) {
  return !std::holds_alternative<DoubleKnifeEdge>(contribution.amplitude) ||
         DoubleKnifeEdge::endpoints_suffice(k * (contribution.psi[1] - contribution.psi[0]));
}

Complex interval_integral(const EdgeContribution& contribution, double k, double from, double to) {
  const double phase = k * (contribution.psi[1] - contribution.psi[0]) * (to - from);
  const double length = contribution.fresnel_taper(k) * contribution.length * (to - from);
  if (std::holds_alternative<UniformAmplitude>(contribution.amplitude)) return length * half_argument_sinc(phase);
  const auto* knives = std::get_if<DoubleKnifeEdge>(&contribution.amplitude);
  if (knives && !DoubleKnifeEdge::endpoints_suffice(phase)) return length * knives->mean(k, phase, from, to);
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

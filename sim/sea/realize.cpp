// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

namespace {

void check_state(const SeaState& state) {
  const double height = state.significant_wave_height_m;
  const double period = state.peak_period_s;
  if (!(height >= 0) || !std::isfinite(height)) {
    throw InputError(fmt::format("sea.significant_wave_height_m: value {}: must be >= 0", height));
  }
  if (!(period > 0) || !std::isfinite(period)) {
    throw InputError(fmt::format("sea.peak_period_s: value {}: must be > 0", period));
  }
  if (!(state.gamma >= 1)) throw InputError(fmt::format("sea.gamma: value {}: must be >= 1", state.gamma));
  if (state.components < 1) throw InputError(fmt::format("sea.components: value {}: must be >= 1", state.components));
  const double peak = 2 * kPi / period;
  if (!(linear_cutoff(state) > peak)) {
    throw InputError(
        fmt::format("sea.cutoff_rad_s: value {}: must be above the peak, {:.4g} rad/s (4 times the peak holds "
                    "all but 0.4 % of the energy)",
                    state.cutoff_rad_s, peak));
  }
  // A regular wave breaks at a height of one seventh of its length (Michell 1893).
  const double steepest = kGravity * period * period / (2 * kPi) / 7;
  if (height > steepest) {
    throw InputError(
        fmt::format("sea.peak_period_s: value {}: too short for Hs = {} m, whose waves would be steeper than breaking "
                    "(Hs <= {:.3g} m)",
                    period, height, steepest));
  }
}

}  // namespace

WaveField realize_sea(const SeaState& state, std::uint64_t seed, std::uint64_t index) {
  check_state(state);
  const Vec2 direction(std::cos(state.propagation_rad), std::sin(state.propagation_rad));
  if (state.significant_wave_height_m == 0) return WaveField({}, direction, state.order, second_order_cutoff(state));

  const JonswapSpectrum spectrum(state.significant_wave_height_m, state.peak_period_s, state.gamma);
  const double lowest = kLowestPeakMultiple * spectrum.peak_omega();
  const double width = (linear_cutoff(state) - lowest) / state.components;
  Random place({seed, Stream::kWaveFrequency, index});
  Random phase({seed, Stream::kWavePhase, index});
  std::vector<WaveComponent> components(static_cast<std::size_t>(state.components));
  double energy = 0;
  for (std::size_t i = 0; i < components.size(); ++i) {
    WaveComponent& component = components[i];
    const double lower = lowest + width * static_cast<double>(i);
    component.omega = lower + width * place.uniform();
    component.wavenumber = component.omega * component.omega / kGravity;
    component.phase = 2 * kPi * phase.uniform();
    component.amplitude = std::sqrt(2 * spectrum.energy(lower, lower + width));
    energy += 0.5 * component.amplitude * component.amplitude;
  }
  // The energy below and above the strata goes to the components in proportion, so that Hs is met exactly.
  const double scale = 0.25 * state.significant_wave_height_m / std::sqrt(energy);
  for (WaveComponent& component : components) component.amplitude *= scale;
  return WaveField(std::move(components), direction, state.order, second_order_cutoff(state));
}

std::uint64_t realisation_index(std::size_t sea_state, std::size_t realisation) {
  constexpr std::uint64_t kMaxRealisations = 1000000;
  SEAGLINT_CHECK(realisation < kMaxRealisations, fmt::format("realisation {}", realisation));
  return sea_state * kMaxRealisations + realisation;
}

SeaSummary summarize(const SeaState& state, const WaveField& field) {
  SeaSummary summary;
  summary.cutoff_rad_s = linear_cutoff(state);
  summary.second_order_cutoff_rad_s = second_order_cutoff(state);
  double m0 = 0;
  for (const WaveComponent& c : field.components()) {
    m0 += 0.5 * c.amplitude * c.amplitude;
    summary.slope_variance += 0.5 * c.amplitude * c.amplitude * c.wavenumber * c.wavenumber;
  }
  summary.significant_wave_height_m = 4 * std::sqrt(m0);
  if (m0 == 0) return summary;

  const JonswapSpectrum spectrum(state.significant_wave_height_m, state.peak_period_s, state.gamma);
  summary.energy_share_above_cutoff = spectrum.energy_above(summary.cutoff_rad_s) / spectrum.energy_above(0);

  // Third cumulant 3 E[eta1^2 eta2] = 3 sum_ij e_i e_j min(k_i, k_j) with e = a^2/2, since B+ + B- = min(k_i, k_j)/2
  // (the statistic as in Marthinsen and Winterstein 1992, ISOPE III, 472); a component of fixed amplitude has half of
  // its own term.
  double below = 0;  // sum of k_j e_j over j < i
  double third = 0;
  for (std::size_t i = 0; i < field.second_order_count(); ++i) {
    const WaveComponent& c = field.components()[i];
    const double e = 0.5 * c.amplitude * c.amplitude;
    third += 3 * e * (2 * below + 0.5 * e * c.wavenumber);
    below += e * c.wavenumber;
  }
  summary.skewness = third / std::pow(m0, 1.5);
  return summary;
}

}  // namespace seaglint

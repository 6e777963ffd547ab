// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/realisation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/spreading.h"

namespace seaglint {

namespace {

void check_system(const std::string& section, double height, double period, double gamma, int components, double cutoff,
                  double depth) {
  if (!(height >= 0) || !std::isfinite(height)) {
    throw InputError(fmt::format("{}.significant_wave_height_m: value {}: must be >= 0", section, height));
  }
  if (!(period > 0) || !std::isfinite(period)) {
    throw InputError(fmt::format("{}.peak_period_s: value {}: must be > 0", section, period));
  }
  if (!(gamma >= 1)) throw InputError(fmt::format("{}.gamma: value {}: must be >= 1", section, gamma));
  if (components < 1) throw InputError(fmt::format("{}.components: value {}: must be >= 1", section, components));
  const double peak = 2 * kPi / period;
  if (!(cutoff > peak)) {
    throw InputError(
        fmt::format("sea.cutoff_rad_s: value {}: must be above the peak, {:.4g} rad/s (4 times the peak contains "
                    "all but 0.4 % of the energy)",
                    cutoff, peak));
  }
  const double steepest = breaking_height(peak, depth);
  if (height > steepest) {
    throw InputError(
        fmt::format("{}.peak_period_s: value {}: too short for Hs = {} m, whose waves would be steeper than breaking "
                    "(Hs <= {:.3g} m)",
                    section, period, height, steepest));
  }
}

void check_state(const SeaState& state) {
  if (!(state.depth_m > 0)) throw InputError(fmt::format("sea.depth_m: value {}: must be > 0", state.depth_m));
  check_system("sea", state.significant_wave_height_m, state.peak_period_s, state.gamma, state.components,
               linear_cutoff(state), state.depth_m);
  const WaveSystemState& swell = state.swell;
  if (swell.significant_wave_height_m == 0) return;
  check_system("sea.swell", swell.significant_wave_height_m, swell.peak_period_s, swell.gamma, swell.components,
               swell_cutoff(state), state.depth_m);
}

// A wave system (wind sea or swell) with its frequency strata.
struct WaveSystem {
  double StratumWidths::*width = nullptr;  // field of this system
  std::unique_ptr<Spectrum> spectrum;
  double cutoff = 0;  // rad/s
  int components = 0;
  double propagation = 0;  // rad
  SpreadingSpec spreading;
};

std::vector<WaveSystem> systems_of(const SeaState& state) {
  std::vector<WaveSystem> systems;
  if (auto spectrum = wind_sea_spectrum(state)) {
    systems.push_back({&StratumWidths::wind_sea, std::move(spectrum), linear_cutoff(state), state.components,
                       state.propagation_rad, state.spreading});
  }
  if (auto spectrum = swell_spectrum(state)) {
    systems.push_back({&StratumWidths::swell, std::move(spectrum), swell_cutoff(state), state.swell.components,
                       state.swell.propagation_rad, state.swell.spreading});
  }
  return systems;
}

double stratum_width(const WaveSystem& system) {  // rad/s
  return (system.cutoff - system.spectrum->lowest_omega()) / system.components;
}

Vec2 unit_vector(double angle) {
  Vec2 direction;
  unit_phasors({&angle, 1}, {&direction.x(), 1}, {&direction.y(), 1});
  return direction;
}

// The streams of one realisation; the swell continues them after the wind sea.
struct WaveRandom {
  Random place, phase, direction, amplitude;
};

std::vector<WaveComponent> realise_system(const WaveSystem& system, const SeaState& state, WaveRandom& random) {
  const Spectrum& spectrum = *system.spectrum;
  const double lowest = spectrum.lowest_omega();
  const double width = stratum_width(system);
  // Directions of components adjacent in frequency are spread by multiples of the golden ratio, which fill (0, 1)
  // evenly.
  constexpr double kGolden = 0.61803398874989484820;
  double probability = system.spreading.kind == Spreading::kNone ? 0 : random.direction.uniform();
  std::vector<WaveComponent> components(static_cast<std::size_t>(system.components));
  double energy = 0;
  for (std::size_t i = 0; i < components.size(); ++i) {
    WaveComponent& component = components[i];
    const double lower = lowest + width * static_cast<double>(i);
    component.omega = lower + width * random.place.uniform();
    component.wavenumber = wavenumber_at(component.omega, state.depth_m);
    component.phase = 2 * kPi * random.phase.uniform();
    component.amplitude = std::sqrt(2 * spectrum.energy(lower, lower + width));
    energy += 0.5 * component.amplitude * component.amplitude;
    double angle = 0;
    if (system.spreading.kind != Spreading::kNone) {
      probability += kGolden;
      if (probability >= 1) probability -= 1;
      // Keeps the probability off 0 and 1, the ends of the circle.
      angle = spreading_quantile(system.spreading, std::clamp(probability, 1e-12, 1 - 1e-12),
                                 component.omega / spectrum.peak_omega());
    }
    component.direction = unit_vector(system.propagation + angle);
  }
  // The energy outside of the strata is distributed over the components in proportion, so that Hs is exact.
  const double scale = std::sqrt(spectrum.total_energy()) / std::sqrt(energy);
  for (WaveComponent& component : components) component.amplitude *= scale;
  if (state.amplitude == WaveAmplitude::kRandom) {
    // Two normal quadratures of equal variance: a^2 is exponential.
    for (WaveComponent& component : components) {
      component.amplitude *= std::sqrt(-reproducible_log(random.amplitude.uniform()));
    }
  }
  return components;
}

}  // namespace

WaveField realise_sea(const SeaState& state, std::uint64_t seed, std::uint64_t index) {
  check_state(state);
  WaveRandom random{Random({seed, Stream::kWaveFrequency, index}), Random({seed, Stream::kWavePhase, index}),
                    Random({seed, Stream::kWaveDirection, index}), Random({seed, Stream::kWaveAmplitude, index})};
  std::vector<WaveComponent> components;
  for (const WaveSystem& system : systems_of(state)) {
    const std::vector<WaveComponent> part = realise_system(system, state, random);
    components.insert(components.end(), part.begin(), part.end());
  }
  std::stable_sort(components.begin(), components.end(),
                   [](const WaveComponent& a, const WaveComponent& b) { return a.omega < b.omega; });
  return WaveField(std::move(components), state.order, second_order_cutoff(state), state.depth_m);
}

StratumWidths stratum_widths(const SeaState& state) {
  StratumWidths widths;
  for (const WaveSystem& system : systems_of(state))
    widths.*system.width = stratum_width(system) / system.spectrum->peak_omega();
  return widths;
}

}  // namespace seaglint

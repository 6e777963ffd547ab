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
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/spectrum.h"

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

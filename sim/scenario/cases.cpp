// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/cases.h"

#include <algorithm>
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

double echo_duration_us(const RadarSpec& radar, double window_m) {
  return radar.pulse_width_us + 2e6 * window_m / kSpeedOfLight;
}

namespace {

// Peak periods of a wind sea: given, by its steepness, or by a rule. DNV: 3.96 sqrt(Hs), within the validity of JONSWAP
// by DNV-RP-C205, 3.5.5.5, 3.6 to 5 sqrt(Hs). Fetch: f U/g = 3.5 (g F/U^2)^-0.33 (Hasselmann et al. 1973), not limited
// by the fully developed sea.
Sweep peak_periods(const SeaSpec& spec, double height) {
  if (spec.table_values) return {2 * kPi / spec.table_values->peak_omega()};
  if (!spec.steepness.empty()) {
    Sweep periods;  // of the steepness Sp = 2 pi Hs / (g Tp^2)
    for (const double steepness : spec.steepness)
      periods.push_back(std::sqrt(2 * kPi * height / (kGravity * steepness)));
    return periods;
  }
  switch (spec.period_rule) {
    case PeakPeriod::kDnvWindSea: return {3.96 * std::sqrt(height)};
    case PeakPeriod::kWindAndFetch: {
      const double speed = spec.wind.speed_mps;
      const double fetch = kGravity * 1000 * spec.wind.fetch_km / (speed * speed);
      return {speed / kGravity / (3.5 * reproducible_exp(-0.33 * reproducible_log(fetch)))};
    }
    case PeakPeriod::kGiven: break;
  }
  return spec.peak_period_s;
}

// DNV-RP-C205, 3.5.5.5.
double dnv_gamma(double height, double period) {
  const double ratio = height > 0 ? period / std::sqrt(height) : 5;
  if (ratio <= 3.6) return 5;
  return ratio < 5 ? reproducible_exp(5.75 - 1.15 * ratio) : 1;
}

Sweep gammas(const SeaSpec& spec, double height, double period) {
  if (spec.spectrum != SpectrumKind::kJonswap) return {1};
  return spec.gamma_rule == PeakEnhancement::kDnvRule ? Sweep{dnv_gamma(height, period)} : spec.gamma;
}

// Peak period and enhancement of a spectrum.
struct Peak {
  double period = 0;
  double gamma = 1;
};

// Those of the mean periods `periods`, with the ratio of the mean to the peak period. With the rule of DNV, gamma
// depends on the peak period and so on itself: a fixed point, approached by a fifth in every step.
void add_peaks(const SeaSpec& spec, double height, const Sweep& periods, double (*ratio)(double gamma),
               std::vector<Peak>& peaks) {
  for (const double period : periods) {
    if (spec.spectrum == SpectrumKind::kJonswap && spec.gamma_rule == PeakEnhancement::kDnvRule) {
      double gamma = 1;
      for (int i = 0; i < 40; ++i) gamma = dnv_gamma(height, period / ratio(gamma));
      peaks.push_back({period / ratio(gamma), gamma});
      continue;
    }
    for (const double gamma : gammas(spec, height, period)) peaks.push_back({period / ratio(gamma), gamma});
  }
}

// Of one significant wave height: periods slowest.
std::vector<Peak> peaks_of(const SeaSpec& spec, double height) {
  std::vector<Peak> peaks;
  add_peaks(spec, height, spec.energy_period_s, energy_period_ratio, peaks);
  add_peaks(spec, height, spec.zero_crossing_period_s, zero_crossing_period_ratio, peaks);
  if (!peaks.empty()) return peaks;
  for (const double period : peak_periods(spec, height)) {
    for (const double gamma : gammas(spec, height, period)) peaks.push_back({period, gamma});
  }
  return peaks;
}

// The direction that waves travel towards, of that which they come from, deg within [-360, 360].
double towards_deg(double coming_from_deg) {
  return coming_from_deg < 180 ? coming_from_deg + 180 : coming_from_deg - 180;
}

Sweep propagations_deg(const SeaSpec& spec) {
  if (spec.coming_from_deg.empty()) return spec.propagation_deg;
  Sweep directions;
  for (const double from : spec.coming_from_deg) directions.push_back(towards_deg(from));
  return directions;
}

WaveSystemState swell_of(const SwellSpec& spec) {
  double period = spec.peak_period_s;
  if (spec.energy_period_s) period = *spec.energy_period_s / energy_period_ratio(spec.gamma);
  if (spec.zero_crossing_period_s) period = *spec.zero_crossing_period_s / zero_crossing_period_ratio(spec.gamma);
  const double propagation = spec.coming_from_deg ? towards_deg(*spec.coming_from_deg) : spec.propagation_deg;
  return {spec.significant_wave_height_m, period, spec.gamma, radians(propagation), spec.spreading, spec.components};
}

double default_cutoff(const SeaSpec& spec, double period) {
  if (spec.table_values) return spec.table_values->omega.back();
  const double peak_rad_s = period > 0 ? 2 * kPi / period : 0;
  return std::max(8.0, 4 * peak_rad_s);
}

}  // namespace

double convergent_cutoff(const SeaState& state) {
  const double height = total_wave_height(state);
  if (height == 0) return state.cutoff_rad_s;  // on flat water no component is too short for the expansion
  return std::sqrt(2 * kGravity / height * reproducible_tanh(2 * state.depth_m / height));
}

double total_wave_height(const SeaState& state) {
  const double wind = state.significant_wave_height_m, swell = state.swell.significant_wave_height_m;
  return std::sqrt(wind * wind + swell * swell);
}

double main_direction_rad(const SeaState& state) {
  return state.swell.significant_wave_height_m > state.significant_wave_height_m ? state.swell.propagation_rad
                                                                                 : state.propagation_rad;
}

std::vector<SeaState> sea_states(const SeaSpec& spec) {
  std::vector<SeaState> states;
  const Sweep heights = spec.height_rule == WaveHeight::kFromTable && spec.table_values
                            ? Sweep{4 * std::sqrt(spec.table_values->energy())}
                            : spec.significant_wave_height_m;
  const Sweep directions = propagations_deg(spec);
  const WaveSystemState swell = swell_of(spec.swell);
  for (const double height : heights) {
    for (const Peak& peak : peaks_of(spec, height)) {
      for (const double propagation : directions) {
        SeaState state;
        state.significant_wave_height_m = height;
        state.peak_period_s = peak.period;
        state.gamma = peak.gamma;
        state.propagation_rad = radians(propagation);
        state.propagation_deg = propagation;
        state.order = spec.order;
        state.components = spec.components;
        state.spreading = spec.spreading;
        state.normalisation = spec.normalisation;
        state.table = spec.table_values;
        state.swell = swell;
        state.depth_m = spec.depth_m.value_or(kDeepWater);
        state.amplitude = spec.amplitude;
        state.cutoff_rad_s = spec.cutoff_rad_s > 0 ? spec.cutoff_rad_s : default_cutoff(spec, peak.period);
        state.second_order_cutoff_rad_s =
            spec.second_order_cutoff_rad_s > 0 ? spec.second_order_cutoff_rad_s : convergent_cutoff(state);
        states.push_back(state);
      }
    }
  }
  return states;
}

std::vector<View> views(const ViewSpec& spec) {
  std::vector<View> all;
  for (const double azimuth : spec.azimuth_deg) {
    for (const double elevation : spec.elevation_deg)
      all.push_back({radians(azimuth), radians(elevation), azimuth, elevation});
  }
  return all;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sea states and views spanned by the sweeps of a scenario, derived quantities, and the shape of the JONSWAP spectrum
// (gamma = 1: Pierson-Moskowitz in Bretschneider's form) over u = w / wp.

#include <vector>

#include "sim/scenario/radar_spec.h"
#include "sim/scenario/sea_spec.h"

namespace seaglint {

// Duration of the echo of a range window of full width window_m, pulse included, us; it must end before the next pulse.
double echo_duration_us(const RadarSpec& radar, double window_m);

// All sea states of the sweeps: significant wave height slowest, then peak period (or steepness), gamma, propagation.
std::vector<SeaState> sea_states(const SeaSpec& spec);

// Significant wave height of wind sea and swell together, m.
double total_wave_height(const SeaState& state);

// Direction of propagation of the higher of wind sea and swell, rad.
double main_direction_rad(const SeaState& state);

// Frequency where k Hs = 2, rad/s: for shorter components the second-order expansion is invalid. On flat water the
// linear cut-off.
double convergent_cutoff(const SeaState& state);

struct View {
  double azimuth_rad = 0;
  double elevation_rad = 0;
  double azimuth_deg = 0;  // as given: conversion to radians and back changes the last bit
  double elevation_deg = 0;
};

// All views of the sweeps, azimuth slowest.
std::vector<View> views(const ViewSpec& spec);

// Peak enhancement gamma^r - 1, r = exp(-(u-1)^2 / (2 s^2)), s = 0.07 below the peak and 0.09 above (Hasselmann et al.
// 1973, "Measurements of wind-wave growth and swell decay during JONSWAP", Deutsche Hydrogr. Z. A8(12), eq. 2.4.1).
double jonswap_enhancement(double u, double gamma);

// Beyond these u the enhancement is below double precision: ten standard deviations from the peak.
inline constexpr double kEnhancementBegin = 0.3, kEnhancementEnd = 1.9;

// Energy period Te = 2 pi m_-1 / m_0 and mean zero-crossing period Tz = 2 pi sqrt(m_0 / m_2) over the peak period, of
// the whole spectrum without a cut-off; gamma >= 1. Relative error 1e-10. At gamma 1: 0.8572 and 0.7104.
double energy_period_ratio(double gamma);
double zero_crossing_period_ratio(double gamma);

}  // namespace seaglint

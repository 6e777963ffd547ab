// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sea states and views spanned by the sweeps of a scenario, and derived quantities.

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

}  // namespace seaglint

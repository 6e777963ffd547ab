// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sea states and views that the sweeps of a scenario span, and quantities of one of them.

#include <vector>

#include "sim/scenario/radar_spec.h"
#include "sim/scenario/sea_spec.h"

namespace seaglint {

// How long the echo of a range window of this full width lasts with the pulse, us; it must end before the next pulse.
double echo_duration_us(const RadarSpec& radar, double window_m);

// The sea states of the sweeps, significant wave height slowest, then peak period, gamma, propagation.
std::vector<SeaState> sea_states(const SeaSpec& spec);

// Significant wave height of the wind sea and the swell together, m.
double total_wave_height(const SeaState& state);

// The frequency where k Hs = 2, rad/s: components above it would enter the second order as ripples steeper than the
// expansion holds for. The linear cut-off on flat water.
double convergent_cutoff(const SeaState& state);

struct View {
  double azimuth_rad = 0;
  double elevation_rad = 0;
  double azimuth_deg = 0;  // as given: a turn to radians and back moves the last bit
  double elevation_deg = 0;
};

// The views of the sweeps, azimuth slowest.
std::vector<View> views(const ViewSpec& spec);

}  // namespace seaglint

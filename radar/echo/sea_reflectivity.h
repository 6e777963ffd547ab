// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Absolute level of sea clutter.

#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Mean reflectivity sigma0 of the sea, dB m^2/m^2. Gregers-Hansen and Mital, "An improved empirical model for radar sea
// clutter reflectivity", NRL/MR/5310-12-9346 (2012), its closed form and coefficients: fitted to measurements between
// 0.5 and 35 GHz, 0.1 and 60 deg of grazing, Douglas sea state 0 to 6, within 2 to 3 dB. hh or vv.
double nrl_reflectivity_db(Polarisation polarisation, double grazing_rad, double frequency_hz, double sea_state);

// Douglas sea state of a significant wave height, WMO code table 3700: interpolated linearly between the limits of
// class n, which have the values n - 1/2 and n + 1/2; 0 at 0 m. Up to 6 m (state 6.5).
double douglas_sea_state(double significant_wave_height_m);

// Area of the clutter patch within range_extent_m of slant range, m^2: range_extent_m r theta_e / cos(grazing), theta_e
// the two-way width of a Gaussian antenna beam, sqrt(pi / (8 ln 2)) of its one-way half-power width.
double clutter_patch_area_m2(const RadarSpec& radar, double grazing_rad, double range_extent_m);

}  // namespace seaglint

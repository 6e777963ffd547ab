// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Absolute level of the sea's echo: mean reflectivity sigma0 by four empirical models.

#include "radar/echo/clutter_scene.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// What the models depend on. All know hh and vv.
struct SeaIllumination {
  Polarisation polarisation = Polarisation::kVv;
  double grazing_rad = 0;
  double frequency_hz = 0;
  double sea_state = 0;      // Douglas
  double upwind_cosine = 0;  // of the angle between the horizontal line of sight and the direction that the wind comes
                             // from: 1 looking upwind, -1 downwind; kNrl has no wind direction
};

// Mean reflectivity of the sea, dB m^2/m^2, within reflectivity_range() of the model:
// * kNrl: Gregers-Hansen and Mital, "An improved empirical model for radar sea clutter reflectivity",
//   NRL/MR/5310-12-9346 (2012), its closed form and coefficients, fitted to Nathanson's tables.
// * kGit: Horst, Dyer and Tuley, "Radar sea clutter model", IEE Conf. Publ. 169 (1978) 6: interference by multipath,
//   wind speed, and wind direction as factors.
// * kHyb: Reilly and Dockery, "Influence of evaporation ducts on radar sea return", IEE Proc. F 137 (1990) 80: decibels
//   above a reference of state 5, 0.1 deg, vv, upwind.
// * kTsc: Technology Service Corporation, as given by Antipov, "Simulation of sea clutter returns", DSTO-TR-0679
//   (1998); its lengths are feet, its wind knots.
// Mean over wind directions less Nathanson's tables: tests/radar/echo/sea_reflectivity_test.cpp.
double sea_reflectivity_db(ClutterLevel model, const SeaIllumination& sea);

// sigma0 (dB) of a scene at a frequency; clutter.level must be absolute. Upwind where the waves travel towards the
// radar.
double sea_reflectivity_db(const ClutterSpec& clutter, const ClutterScene& scene, double frequency_hz);

// The Douglas sea state that is given, or else that of the scene's waves.
double sea_state_of(const ClutterSpec& clutter, const ClutterScene& scene);

// Douglas sea state of a significant wave height, WMO code table 3700: interpolated linearly between the limits of
// class n, which have the values n - 1/2 and n + 1/2; 0 at 0 m. Up to 6 m (state 6.5).
double douglas_sea_state(double significant_wave_height_m);

}  // namespace seaglint

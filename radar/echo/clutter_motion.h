// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How fast the sea's scatterers move along the line of sight, as the waves and the wind that made them demand.

#include <cstdint>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scenario/radar_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// The sea around the target in one interval, as far as its echo follows it.
struct ClutterScene {
  RadarSpec radar;             // polarisation, range, beam, transmitter
  Vec3 r_hat = Vec3::UnitX();  // to the radar, target frame
  double significant_wave_height_m = 0;
  const WaveField* waves = nullptr;  // needed unless clutter.doppler is given
  double start_s = 0;                // of the interval, in the waves' time
  Vec3 target_velocity_mps =
      Vec3::Zero();               // of the target through the water, which its frame and the radar go along with
  std::uint64_t texture_key = 0;  // intervals of one key see one texture that changes over time
};

struct VelocityMoments {
  double mean_mps = 0;    // positive = receding
  double spread_mps = 0;  // standard deviation
};

// What waves and wind give the scatterers, after Trizna, "A model for Doppler peak spectral shift for low grazing angle
// sea scatter", IEEE J. Oceanic Eng. 10 (1985) 368: for vv the phase speed of the Bragg waves, the wind's drift and the
// Stokes drift, all along the waves; other polarisations are faster by hh_velocity_factor, as that paper found without
// a model. Spread: the radial part of the waves' orbital velocity. The wind is that of a fully developed sea of this
// height (Pierson and Moskowitz, J. Geophys. Res. 69 (1964) 5181), and drifts the surface by 3 % of its speed (Wu, J.
// Fluid Mech. 68 (1975) 49). No waves: no motion but that of the water past a target on its way.
VelocityMoments clutter_velocity_moments(const ClutterSpec& spec, const ClutterScene& scene, double wavelength_m);

// What a radar that passes by adds to the spread, on its own way and the target's: scatterers off the middle of the
// beam come nearer or go away, by the speed across the line of sight times the deviation of the two-way Gaussian beam,
// width / (4 sqrt(ln 2)).
double platform_doppler_spread_mps(const ClutterScene& scene);

// Radial motion of scatterers that float on the waves: displacement at the time t after the interval's start is v t + a
// t^2/2.
struct FloatingScatterers {
  std::vector<double> velocity_mps;
  std::vector<double> acceleration_mps2;
};

// The water's motion in scene.waves at scatterers of the given slant ranges from the reference point (positive =
// farther), each at a random place across the beam (Gaussian, two ways), stream kClutterPlace of (seed, index), less
// the mean that it has at the moving surface: clutter_velocity_moments holds the whole Stokes drift. Velocity is taken
// at both ends of the interval.
FloatingScatterers floating_scatterers(const ClutterScene& scene, const std::vector<double>& range_m, double duration_s,
                                       std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sea clutter: radial velocity of its scatterers from waves and wind, and its response, a K-distributed sum of many
// scatterers with individual Doppler evolution.

#include <cstdint>
#include <optional>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/linear.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

class WaveField;

// Sea around the target during one interval.
struct ClutterScene {
  RadarSpec radar;             // polarisation, range, antenna beam, transmitter
  Vec3 r_hat = Vec3::UnitX();  // to the radar, target frame
  double significant_wave_height_m = 0;
  double waves_towards_rad = 0;             // direction of propagation of waves and wind
  const WaveField* waves = nullptr;         // required unless clutter.doppler is prescribed
  double start_s = 0;                       // start of the interval on the time axis of the waves
  Vec3 target_velocity_mps = Vec3::Zero();  // of the target through the water; its frame and the radar move with it
  std::uint64_t texture_key = 0;            // intervals of one key have one texture, evolving in time
};

struct VelocityMoments {
  double mean_mps = 0;    // positive = receding
  double spread_mps = 0;  // standard deviation
};

// Mean and standard deviation of the radial velocity, after Trizna, "A model for Doppler peak spectral shift for low
// grazing angle sea scatter", IEEE J. Oceanic Eng. 10 (1985) 368: mean for vv: phase speed of the Bragg waves, wind
// drift and Stokes drift, all along the wave direction; other polarisations times hh_velocity_factor (empirical in that
// paper). Spread: radial orbital velocity of the waves. The wind is that of a fully developed sea of this height
// (Pierson and Moskowitz, J. Geophys. Res. 69 (1964) 5181), with a surface drift of 3 % of its speed (Wu, J. Fluid
// Mech. 68 (1975) 49). Without waves only the motion of the water relative to a target under way remains.
VelocityMoments clutter_velocity_moments(const ClutterSpec& spec, const ClutterScene& scene, double wavelength_m);

// Doppler spread due to the relative motion of radar and target: scatterers off the axis of the antenna beam have an
// additional radial velocity, whose standard deviation is the speed across the line of sight times that of the two-way
// Gaussian beam, width / (4 sqrt(ln 2)).
double platform_doppler_spread_mps(const ClutterScene& scene);

// Radial motion of scatterers on the waves: displacement v t + a t^2/2 at time t after the start of the interval.
struct FloatingScatterers {
  std::vector<double> velocity_mps;
  std::vector<double> acceleration_mps2;
};

// Water motion of scene.waves at scatterers of the given slant ranges from the reference point (positive = farther),
// each at a random cross-range position (two-way Gaussian beam), stream kClutterPlace of (seed, index), minus the mean
// at the moving surface, since clutter_velocity_moments() includes the whole Stokes drift. Velocity is evaluated at
// both ends of the interval.
FloatingScatterers floating_scatterers(const ClutterScene& scene, const std::vector<double>& range_m, double duration_s,
                                       std::uint64_t seed, std::uint64_t index);

// Quantile Phi(normal) of the gamma distribution with mean 1 and the given shape (0.1 <= shape <= 1000); monotone in
// normal, so that correlated normal values give correlated texture. Relative error below 1e-11 for |normal| <= 8.
double gamma_texture(double shape, double normal);

// Shape of the K distribution of measured clutter, Ward, Tough and Watts, "Sea Clutter", 2nd ed. 2013, section 2.9:
// log10 shape = 2/3 log10 grazing (deg) + 5/8 log10 A - k - cos(2 theta) / 3, A the area of a cell (m^2), k 1.39 for
// vv, 2.09 for hh, theta the angle between the line of sight and the swell, here the waves. Absent outside of what it
// was fitted to: 9 to 10 GHz, 0.1 to 10 deg, cells of 100 to 800 m across, hh and vv.
std::optional<double> k_shape(const ClutterScene& scene, double frequency_hz, double range_cell_m);

// Gamma-distributed texture of mean 1 and shape spec.texture_shape on `cells` points of a ring at one time. Correlation
// of its Gaussian generator: e^{-d^2 / (2 l^2)} along the ring, d and l in cells, and e^{-(t /
// texture_correlation_time_s)^2 / 2} between times of one key (stream kTexture).
std::vector<double> sea_texture(int cells, double correlation_cells, const ClutterSpec& spec, double time_s,
                                std::uint64_t seed, std::uint64_t key);

// H of the clutter at the frequencies of every pulse, [pulse][frequency], ensemble mean power 1. Scatterers fill the
// whole unambiguous range window and are the same at every carrier and on every refinement of the frequency grid; their
// velocities follow spec.doppler. Speckle: stream kClutter of (seed, index); texture: scene.texture_key.
std::vector<Complex> clutter_response(const PulseTrain& train, const ClutterSpec& spec, const ClutterScene& scene,
                                      std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint

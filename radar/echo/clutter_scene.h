// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sea as the radar sees it during an interval, and what follows from it for clutter: area of a cell, mean and
// spread of the radial velocity, shape and correlation of the texture.

#include <cstdint>

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
  Vec3 current_mps = Vec3::Zero();          // of the water with its waves in the frame, in which floats drift
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
// Mech. 68 (1975) 49). Without waves only the current, and the motion of the water relative to a target under way,
// remain.
VelocityMoments clutter_velocity_moments(const ClutterSpec& spec, const ClutterScene& scene, double wavelength_m);

// Doppler spread due to the relative motion of radar and target: scatterers off the axis of the antenna beam have an
// additional radial velocity, whose standard deviation is the speed across the line of sight times that of the two-way
// Gaussian beam, width / (4 sqrt(ln 2)).
double platform_doppler_spread_mps(const ClutterScene& scene);

// Standard deviation of the two-way gain across the beam at the range of the target, m: e^{-8 ln2 phi^2 / width^2} is a
// normal density over azimuth of deviation width / (4 sqrt(ln 2)).
double beam_deviation_m(const RadarSpec& radar);

// Cosine of the angle between the horizontal direction to the radar and that of the waves: 1, waves run towards it.
double upwind_cosine(const ClutterScene& scene);

// Area of the clutter patch within range_extent_m of slant range, m^2: range_extent_m r theta_e / cos(grazing), theta_e
// the two-way width of a Gaussian antenna beam, sqrt(pi / (8 ln 2)) of its one-way half-power width.
double clutter_patch_area_m2(const RadarSpec& radar, double grazing_rad, double range_extent_m);

// Wind 10 m above a fully developed sea of this height, m/s (Pierson and Moskowitz 1964): Hs = 0.22 U^2 / g.
double developed_wind_mps(double significant_wave_height_m);

// A figure of measured clutter, and whether the scene is within what it was fitted to.
struct FittedFigure {
  double value = 0;
  bool is_within_range = false;
};

// Shape of the K distribution of measured clutter, Ward, Tough and Watts, "Sea Clutter", 2nd ed. 2013, section 2.9:
// log10 shape = 2/3 log10 grazing (deg) + 5/8 log10 A - k - cos(2 theta) / 3, A the area of a cell (m^2), k 1.39 for
// vv, 2.09 for others, theta the angle between the line of sight and the swell, here the waves; at least 0.1, at most
// 1000. Fitted to 9 to 10 GHz, 0.1 to 10 deg, hh and vv, cells of 100 to 800 m across and 4.2 m in range, a length that
// k contains (5/8 log10 4.2 = 0.39); beyond, the grazing angle is that of the nearest limit.
FittedFigure k_shape(const ClutterScene& scene, double frequency_hz, double range_cell_m);

// Distance in range over which the correlation of the texture of measured clutter falls to 1/e, m: (pi/2) (U^2 / g)
// sqrt(3 cos^2 theta + 1), theta the angle between the line of sight and the wind; Watts, "Cell-averaging CFAR gain in
// spatially correlated K-distributed clutter", IEE Proc. Radar Sonar Navig. 143 (1996) 321.
double texture_length_m(const ClutterScene& scene);

// Texture and speckle of a scene: values of the spec where it has them.
struct TextureParameters {
  double shape = 2;               // of the K distribution of a range cell
  double correlation_cells = 5;   // e^{-d^2 / (2 l^2)}, l in range cells, of the texture that is not of the waves
  double correlation_time_s = 3;  // e^{-t^2 / (2 T^2)}, likewise
  double spread_mps = 0.5;        // of the velocity of a scatterer on moving water that does not break
};
TextureParameters texture_parameters(const ClutterSpec& spec, const ClutterScene& scene, double frequency_hz,
                                     double range_cell_m);

}  // namespace seaglint

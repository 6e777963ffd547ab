// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scatterers of the sea during one interval: local power, radial motion on the waves and width of the speckle of each.
// With texture: waves all three follow the waves of the sea realisation.

#include <cstdint>
#include <vector>

#include "radar/echo/clutter_scene.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Quantile Phi(normal) of the gamma distribution with mean 1 and the given shape (0.1 <= shape <= 1000); monotone in
// normal, so that correlated normal values give correlated texture. Relative error below 1e-11 for |normal| <= 8.
double gamma_texture(double shape, double normal);

// Gaussian field of variance 1 on `cells` points of a ring at one time: correlation e^{-d^2 / (2 l^2)} along the ring,
// d and l in cells, and e^{-(t / T)^2 / 2} between times of one seed (stream kTexture).
std::vector<double> ring_field(int cells, double correlation_cells, double correlation_time_s, double time_s,
                               std::uint64_t seed);

// Modulation of the local power by the waves as seen from the radar. Power rises with the elevation (shadowing by
// crests in front) and with the slope that faces the radar (tilt); the normal score of local power is
//   g = rho (cos(a) eta / sigma_eta + sin(a) s / sigma_s) + sqrt(1 - rho^2) n,
// eta the linear elevation of the waves below 2.5 rad/s, s their slope along the line of sight, positive facing the
// radar, n a Gaussian field apart from the waves. rho^2 is the part of the variance of log power that tilt explains,
// (p sigma_s / E[(tan grazing + s)+])^2 over trigamma(shape), at most 0.81: p = 2.6 the exponent of sigma0 over grazing
// angle of the NRL model, E[(..)+] the mean slope of the illuminated surface, as tilted facets and geometrical
// shadowing have it (Smith, IEEE Trans. Antennas Propag. 15 (1967) 668); trigamma(shape) is the variance of the
// logarithm of a gamma variate. The lead a = 25 deg and the bound of rho are fitted to measured clutter (README.md).
struct WaveModulation {
  double tilt_log_deviation = 0;  // p sigma_s / E[(tan grazing + s)+]
  double breaking = 0;            // 0 to 1: sigma_s / 0.06, at most 1
  double shape = 1;               // of the gamma texture of a scatterer
  double rho = 0;
};
// The shape of a scatterer is such that the power in a range cell has the shape of the texture: scatterers_per_cell of
// them in each range_cell_m = c/(2B), weighted by the response of Hann's taper, at random places across the antenna
// beam, over which the correlation of pairs is averaged. Hermite coefficients of the gamma texture (Mehler's formula).
WaveModulation wave_modulation(const TextureParameters& texture, const ClutterScene& scene, int scatterers_per_cell,
                               double range_cell_m);

// State of scatterers at nodes, uniform in time from the start of the interval; linear between nodes.
struct SeaScatterers {
  int count = 0;
  double step_s = 0;  // between nodes
  // [node][scatterer]:
  std::vector<double> amplitude;     // mean square 1 / count; one node: constant
  std::vector<double> velocity_mps;  // positive = receding, without the mean of clutter; may be empty
  std::vector<double> width_mps;     // of the speckle; empty: that of the spec
};

// Places of scatterers in range: index k of `count` is at k W / count of the window W, or W below it for the upper
// half, so that they fill half a window on either side of the reference point.
int place_of(int k, int count);

// What an interval of clutter is made of.
struct ScattererRequest {
  const ClutterSpec& spec;
  const ClutterScene& scene;
  TextureParameters texture;
  int per_cell = 2;       // scatterers per range cell
  int count = 0;          // in the window
  double window_m = 0;    // unambiguous range
  double duration_s = 0;  // of the interval
  double mean_mps = 0;    // velocity of the clutter relative to the reference point, positive = receding
  std::uint64_t seed = 0, index = 0;
};
// Power: stream kTexture of (seed, scene.texture_key). Motion: velocity of the water of scene.waves at the range of
// each scatterer and a random position across the two-way Gaussian beam, stream kClutterPlace of (seed, index), minus
// the mean at the moving surface, since clutter_velocity_moments() includes the whole Stokes drift.
// * texture: independent: constant power, one width, velocity at both ends of the interval.
// * texture: waves: nodes at most 0.1 s apart, places that drift with the mean velocity. Power by wave_modulation.
// Width
//   s = s0 e^{b h - b^2/2}, h = 0.85 g + sqrt(1 - 0.85^2) m, m a Gaussian field apart from the waves, b = breaking;
//   velocity along the waves larger by 2 (s - s0), so that bright scatterers are faster and broader (Watts, "Modeling
//   and simulation of coherent sea clutter", IEEE Trans. Aerosp. Electron. Syst. 48 (2012) 3303). Sea spikes of
//   polarisations other than vv: three tenths of the variance of n change within 0.2 s, and the velocity is larger by 4
//   (s - s0).
SeaScatterers sea_scatterers(const ScattererRequest& request);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scatterers of the sea during one interval: local power, radial velocity and width of the speckle of each. With
// texture: waves all three are modulated by the long waves of the sea realisation.

#include <cstdint>
#include <functional>
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

// Modulation by the waves below 2.5 rad/s, 10 m long in deep water. Local power is the gamma quantile of Phi(g),
//   g = rho (cos(a) eta / sigma_eta + sin(a) s / sigma_s) + sqrt(1 - rho^2) n,
// eta the linear elevation, s the slope along the line of sight, positive facing the radar, n a Gaussian field
// independent of the waves: power rises with the elevation, as crests in front shadow, and with the slope that faces
// the radar. rho^2 is the part of the variance of log power that this tilt explains, t^2 / trigamma(shape), at most
// 0.81; trigamma(shape) is the variance of the logarithm of a gamma variate, and
//   t = p sigma_s / E[(tan grazing + s)+]
// the deviation of p log slope; the mean of the slopes that face the radar, over all facets, is tan(grazing) over their
// illuminated fraction by geometrical shadowing (Smith, IEEE Trans. Antennas Propag. 15 (1967) 668). The exponent p =
// 2.6 is that of the sine in the NRL model for vv; the lead a = 25 deg and the bound are fitted to measured clutter
// (README.md). In most scenes rho has its bound; it is smaller for scatterers of a shape below 0.2 and for grazing
// angles above 10 deg.
//
// Speckle has the width
//   w = w0 (1 + 0.55 b e^{1.3 h - 1.3^2/2}), h = min(3, 0.85 g + sqrt(1 - 0.85^2) m),
// w0 the given spread, of water that does not break, b the breaking, the square of the rms slope of these waves over
// 0.06, at most 1, m a Gaussian field independent of the waves; the velocity along the waves is larger by 2 (w - its
// mean). All numbers are fitted. Bright scatterers are therefore faster (Watts, "Modeling and simulation of coherent
// sea clutter", IEEE Trans. Aerosp. Electron. Syst. 48 (2012) 3303) and broader (as Greco, Bordoni and Gini observe
// over long waves, IEEE J. Oceanic Eng. 29 (2004) 269). Sea spikes of polarisations other than vv (Walker, IEE Proc.
// Radar Sonar Navig. 148 (2001) 73; the numbers are choices): three tenths of the variance of n change within 0.2 s,
// and the velocity is larger by 4 (w - its mean).
struct WaveModulation {
  double tilt_log_deviation = 0;  // t
  double breaking = 0;            // b
  double shape = 1;               // of the gamma texture of a scatterer
  double cell_shape = 1;          // of the power in a range cell; larger than that of the texture where no scatterers
                                  // of shape >= 0.1 have it, since a cell averages over them
  double rho = 0;

  double mean_width() const { return 1 + 0.55 * breaking; }  // over w0; the limit of h lowers it by 0.6 % at most
};
// The shape of a scatterer is such that the power in a range cell has the shape of the texture: scatterers_per_cell of
// them in each range_cell_m = c/(2B), weighted by the response of Hann's taper, at random positions across the antenna
// beam, over which the correlation of pairs is averaged. Hermite coefficients of the gamma texture (Mehler's formula).
WaveModulation wave_modulation(const TextureParameters& texture, const ClutterScene& scene, int scatterers_per_cell,
                               double range_cell_m);

// Scatterers per synthetic range cell c/(2 B_s): with two the speckle of a cell is Gaussian and their phases remain
// independent; with texture: waves at least one per metre.
int scatterers_per_cell(const ClutterSpec& spec, double range_cell_m);

// Index of scatterer k of `count` in range, from the reference point outwards: its range is this times W / count, W the
// window, from -W/2 to W/2.
int signed_index(int k, int count);

// State at one time, [scatterer].
struct ScattererState {
  std::vector<double> amplitude;     // mean square 1 / count
  std::vector<double> velocity_mps;  // positive = receding, without the mean of clutter; empty: none
  std::vector<double> width_mps;     // of the speckle; empty: one of all
};

// Scatterers of an interval at nodes 0, 1, .. from its start; linear between them.
struct SeaScatterers {
  double step_s = 0;
  bool is_steady = false;  // amplitudes are those of node 0
  std::function<ScattererState(int node)> at_node;
};

// What an interval of clutter is made of. spec and scene must outlive its scatterers.
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
// Velocity: that of the water of scene.waves at the range of each scatterer, which drifts with the mean velocity and
// re-enters the window on its other side, and at a random position across the two-way Gaussian beam, stream
// kClutterPlace of (seed, index); minus the mean at the moving surface, since clutter_velocity_moments() includes the
// whole Stokes drift. Nodes are at most 0.1 s and three tenths of the correlation time apart. Power: stream kTexture of
// (seed, scene.texture_key).
// * texture: independent: power constant over intervals up to a fifth of the correlation time, one width.
// * texture: waves: power, velocity and width by wave_modulation.
SeaScatterers sea_scatterers(const ScattererRequest& request);

}  // namespace seaglint

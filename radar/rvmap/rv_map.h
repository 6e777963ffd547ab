// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exact range-velocity map of an interval: sums over the pulses of each carrier, then an inverse FFT over the
// synthesised band. Every frequency of every pulse is compensated at its own frequency and time, without approximation.
// The signal-to-clutter ratio of the map is measured in three definitions (README.md).

#include <span>
#include <vector>

#include "radar/echo/echo.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/linear.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct RvMap {
  std::vector<double> range_m;       // relative to the target's reference point at the first pulse, positive = farther
  std::vector<double> velocity_mps;  // positive = receding
  std::vector<Complex> values;       // metres, [velocity][range]; RV = |values|
  int unused_carriers = 0;           // carriers without pulses: their band is zero

  std::size_t columns() const { return range_m.size(); }
  Complex at(std::size_t v, std::size_t r) const { return values[v * range_m.size() + r]; }
};

// Cell grid of a map: range cells c/(2 B_s) / range_oversampling (to the nearest whole number of them in the
// unambiguous window), velocity cells lambda/(2 N T_r) / velocity_oversampling. Counts: those of the spans, at least
// one, at most the unambiguous window and +-lambda/(4 T_r); cell count/2 is at 0. Throws InputError for more than 2^26
// cells.
struct MapGrid {
  std::vector<double> range_m;
  std::vector<double> velocity_mps;
  std::size_t window_cells = 1;  // range cells of the unambiguous window: transform length
};
MapGrid map_grid(const PulseTrain& train, const MapSpec& spec);

// Map of an echo [pulse][frequency] (README.md). A point scatterer of amplitude a (m) has the peak |RV| = a for all
// tapers and gaps; its phase there is that of its response at the band centre at the first pulse. Throws Interrupted
// between velocities when *stop becomes true.
RvMap form_rv_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec, bool intra_pulse_motion,
                  const StopFlag* stop = nullptr);

// Weights of the map as an explicit sum, for the map at one point or the response of one scatterer:
//   RV(r, v) = sum_n sum_b w_n u_k X_n(f_b) e^{+j 4 pi (f_n + f_b) v (t_n + f_b/mu) / c} e^{+j 4 pi (f_n + f_b - f_c) r
//   / c}
// with k = C_n bins_per_hop + b the bin of the synthesised band and f_c the centre of that band (f_b/mu only with
// intra-pulse motion).
struct MapWeights {
  std::vector<double> pulse;  // w_n: velocity taper over its sum for the pulses of the same carrier
  std::vector<double> bin;    // u_k: range taper over the number of carriers that cover bin k, 0 in gaps; a point of
                              // amplitude 1 has peak 1
  int unused_carriers = 0;    // carriers without pulses
};

MapWeights map_weights(const PulseTrain& train, const MapSpec& spec);

// Pulse compression filter on the baseband grid, X = filter Y: P* / |P|^2 (inverse, zero where |P|^2 is below 1e-9 of
// its mean) or P* / mean |P|^2 (matched).
std::vector<Complex> compression_filter(const PulseTrain& train, Compression compression);

// Pulse compression of an echo, [pulse][frequency].
std::vector<Complex> compress_pulses(std::span<const Complex> echo, const PulseTrain& train, Compression compression);

// Samples of a taper of unit peak at the centres of `count` equal cells. Taylor: nbar 4, sidelobes -35 dB.
std::vector<double> taper_samples(Taper taper, std::size_t count);

// Target extent: the smallest rectangle of map cells that contains every cell within 10 dB of the peak; indices, both
// ends included.
struct MapExtent {
  std::size_t range_first = 0, range_last = 0, velocity_first = 0, velocity_last = 0;
};
MapExtent target_extent(const RvMap& target);

// Received signal of an interval with the clutter at the level of the scenario.
struct ReceivedInterval {
  std::vector<Complex> echo;                        // target + clutter + noise, [pulse][frequency]
  RvMap map;                                        // map of that echo
  MeasuredRatios scr;                               // NaN without clutter or noise, and of a target without an echo
  double clutter_power_m2 = 0, noise_power_m2 = 0;  // mean |Y|^2 of the clutter and the noise in it
};

// Sum of target, clutter and noise with its map, and the measured target-to-clutter ratio in three definitions and
// target-to-noise ratio per pulse. clutter.level scr: the clutter, with noise that is relative to it, is first scaled
// so that the ratio of clutter.scr_definition is scr_db exactly in this map:
//   per_pulse  mean |Y_target|^2 over mean |Y_clutter|^2, all pulses and in-band frequencies
//   peak_cell  maximum |RV|^2 of the target over the mean |RV|^2 of the clutter's map
//   extent     mean |RV|^2 of the target inside target_extent over the mean |RV|^2 of the clutter's map
// A target whose echo is zero has no ratios: the level must be absolute. Throws InputError when clutter is present and
// zero in the map, or the target with an echo is; Interrupted as form_rv_map().
ReceivedInterval form_received_interval(const Echo& echo, const PulseTrain& train, const ClutterSpec& clutter,
                                        const MapSpec& spec, bool intra_pulse_motion, const StopFlag* stop = nullptr);

}  // namespace seaglint

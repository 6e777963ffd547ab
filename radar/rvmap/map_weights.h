// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Weights of the range-velocity map as an explicit sum, for the map at one point or the response of one scatterer:
// RV(r, v) = sum_n sum_b w_n u_(k) X_n(f_b) e^{+j 4 pi (f_n + f_b) v (t_n + f_b/mu) / c} e^{+j 4 pi (f_n + f_b - f_c) r
// / c}
// with k = C_n bins_per_hop + b the bin of the synthesised band and f_c the centre of that band (f_b/mu only with
// intra-pulse motion).

#include <span>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

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

}  // namespace seaglint

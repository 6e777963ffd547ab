// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The exact range-velocity map of an interval: sums over the pulses of each carrier, then an inverse FFT over the
// synthesised band. No approximation is made: every frequency of every pulse is compensated at its own frequency and
// time.

#include <span>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/linear.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct RvMap {
  std::vector<double>
      range_m;  // relative to the target's reference point, positive = farther; range at the first pulse
  std::vector<double> velocity_mps;  // positive = receding
  std::vector<Complex> values;       // metres, [velocity][range]; RV = |values|
  int unused_carriers = 0;           // carriers that no pulse used: their band is zero

  std::size_t columns() const { return range_m.size(); }
  Complex at(std::size_t v, std::size_t r) const { return values[v * range_m.size() + r]; }
};

// The cells a map has: range cells c/(2 B_s) / range_oversampling (to the nearest whole number of them in the
// unambiguous window), velocity cells lambda/(2 N T_r) / velocity_oversampling; as many as the spans hold, at least one
// and at most the unambiguous window and +-lambda/(4 T_r); cell count/2 is 0. Throws InputError for more than 2^26
// cells.
struct MapGrid {
  std::vector<double> range_m;
  std::vector<double> velocity_mps;
  std::size_t window_cells = 1;  // range cells in the whole unambiguous window, the length of the transform
};
MapGrid map_grid(const PulseTrain& train, const MapSpec& spec);

// Forms the map of an echo given as [pulse][frequency] (README.md). A point scatterer of amplitude a metres
// peaks at |RV| = a, whatever the tapers and holes; its phase there is that of its answer at the band's centre at the
// first pulse.
RvMap form_rv_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec, bool intra_pulse_motion);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exact range-velocity map of an interval: sums over the pulses of each carrier, then an inverse FFT over the
// synthesised band. Every frequency of every pulse is compensated at its own frequency and time, without approximation.

#include <span>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/linear.h"
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
// tapers and gaps; its phase there is that of its response at the band centre at the first pulse.
RvMap form_rv_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec, bool intra_pulse_motion);

}  // namespace seaglint

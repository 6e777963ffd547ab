// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The exact range-velocity map of an interval (design: one matrix product per carrier, then an inverse FFT over the synthesised band).

#include <span>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/core/linear.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct RvMap {
  std::vector<double> range_m;       // relative to the target's reference point, positive = farther
  std::vector<double> velocity_mps;  // positive = receding
  std::vector<Complex> values;       // metres, [velocity][range]; RV = |values|
  int empty_carriers = 0;            // carriers that no pulse used: their band is zero

  std::size_t columns() const { return range_m.size(); }
  Complex at(std::size_t v, std::size_t r) const { return values[v * range_m.size() + r]; }
};

// Forms the map of an echo given as [pulse][frequency]. A point scatterer of amplitude a metres peaks at |RV| = a (taper normalised).
RvMap form_rv_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec, bool intra_pulse_motion);

}  // namespace seaglint

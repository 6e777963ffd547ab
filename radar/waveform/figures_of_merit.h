// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Resolution, ambiguity and pedestal of a pulse train.

#include <string>

#include "radar/waveform/pulse_train.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Mean power of the point response at (range_offset_m, velocity_offset_mps) from its peak of 1, averaged over all codes
// with the times and pulses per carrier of this train: coherent sidelobes plus random-hop pedestal, for one frequency
// per pulse and no taper. Closed form of radar/waveform/README.md.
double expected_response_power(const PulseTrain& train, double range_offset_m, double velocity_offset_mps);

// Warning about gaps between the bands of the carriers and the resulting sidelobes; empty without gaps.
std::string band_gap_warning(const PulseTrain& train);

// Resolutions, ambiguities, blind range and expected pedestal, one line each, for `seaglint check`.
std::string figures_of_merit_text(const PulseTrain& train, const RadarSpec& spec);

}  // namespace seaglint

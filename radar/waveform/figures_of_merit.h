// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a pulse train can resolve, and how much its hop code smears.

#include <string>

#include "radar/waveform/pulse_train.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Mean power of the point response at (range_offset_m, velocity_offset_mps) from its peak of 1, over all codes with
// this train's times and counts of pulses per carrier: coherent sidelobe plus random-hop pedestal, of the carriers
// alone (one frequency per pulse, no taper). Closed form of radar/waveform/README.md.
double expected_response_power(const PulseTrain& train, double range_offset_m, double velocity_offset_mps);

// What the carriers leave out of the band between them, and the sidelobes that follow; empty where nothing.
std::string band_gap_warning(const PulseTrain& train);

// Resolutions, ambiguities, blind range and expected pedestal, one line each, for `seaglint check`.
std::string figures_of_merit_text(const PulseTrain& train, const RadarSpec& spec);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Thermal noise in the units of the echo.

#include "radar/waveform/pulse_train.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Mean |noise|^2 of one frequency of one pulse, m^2, in the scale in which a target of scattering amplitude a has |Y| =
// a. Radar equation (Richards, Scheer and Holm, "Principles of Modern Radar", vol. 1 (2010), chapter 2) with sigma = 4
// pi a^2: energy of a pulse E = P T_p G^2 lambda^2 sigma / ((4 pi)^3 R^4 L) against N_0 = k T F. The coherent sum of
// the F frequencies of a pulse has the matched-filter ratio E / N_0, so noise^2 = F a^2 N_0 / E.
double thermal_noise_m2(const PulseTrain& train, const RadarSpec& radar);

}  // namespace seaglint

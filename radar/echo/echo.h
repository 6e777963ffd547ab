// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The echo of an interval in the frequency domain: Y_n(f) = P(f) H(f_n + f; attitude at t_n) + clutter + noise.

#include <cstdint>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/scattering/frequency_response.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct Echo {
  int pulses = 0;
  int frequencies = 0;
  std::vector<Complex> target;   // P(f) H, [pulse][frequency]
  std::vector<Complex> clutter;  // clutter and noise, scaled to the wanted SCR; empty when switched off
};

// Levels relative to the target, all measured after generation (radar/echo/README.md); NaN when there is no clutter.
struct ScrMeasured {
  double per_pulse_db = 0;
  double peak_cell_db = 0;
  double extent_db = 0;
};

// The target's echo with sea clutter and noise at the given SCR. Streams kClutter and kNoise of (seed, index).
// Throws InputError when the target has no power.
Echo synthesize_echo(const PulseTrain& train, const FrequencyResponse& response, const ClutterSpec& clutter,
                     std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint

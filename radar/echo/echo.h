// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The echo of an interval in the frequency domain: Y_n(f) = P(f) H(f_n + f; attitude at t_n) + clutter + noise.

#include <cstdint>
#include <span>
#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/scattering/frequency_response.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct Echo {
  int pulses = 0;
  int frequencies = 0;
  std::vector<Complex> target;   // P(f) H, [pulse][frequency]
  std::vector<Complex> clutter;  // clutter and noise together; empty when switched off

  std::vector<Complex> total() const;  // what the radar receives
};

// Levels relative to the target, all measured after generation (radar/echo/README.md); NaN when there is no clutter.
struct ScrMeasured {
  double per_pulse_db = 0;
  double peak_cell_db = 0;
  double extent_db = 0;
};

// Mean of |x|^2; 0 without values.
double mean_power(std::span<const Complex> values);

// The target's echo with sea clutter and noise, scaled so that the per-pulse ratio of mean |target|^2 to mean |clutter
// + noise|^2 is scr_db exactly, whatever the definition: the other two need maps (radar/rvmap/scr.h scales on from
// here). The response is the one asked for by interval_sampling(train, ...). Streams kClutter and kNoise of (seed,
// index). Throws InputError when the target has no power.
Echo synthesize_echo(const PulseTrain& train, const FrequencyResponse& response, const ClutterSpec& clutter,
                     std::uint64_t seed, std::uint64_t index);

}  // namespace seaglint

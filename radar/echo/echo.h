// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The echo of an interval in the frequency domain: Y_n(f) = P(f) H(f_n + f; attitude at t_n) + clutter + noise.

#include <cstdint>
#include <span>
#include <vector>

#include "radar/echo/clutter_motion.h"
#include "radar/waveform/pulse_train.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct Echo {
  int pulses = 0;
  int frequencies = 0;
  std::vector<Complex> target;   // P(f) H, [pulse][frequency]
  std::vector<Complex> clutter;  // P(f) H of the sea; empty without clutter
  std::vector<Complex> noise;    // of the receiver; empty when relative to absent clutter

  std::vector<Complex> total() const;  // target + clutter + noise
};

// Ratios to the target, measured after generation (radar/echo/README.md), dB; NaN without clutter or noise.
struct MeasuredRatios {
  double per_pulse_db = 0;
  double peak_cell_db = 0;
  double scr_extent_db = 0;
  double snr_per_pulse_db = 0;
};

// Mean of |x|^2; 0 for an empty span.
double mean_power(std::span<const Complex> values);

// Echo of the target with sea clutter and noise. clutter.level scr: the clutter is scaled so that mean |target|^2 over
// mean |clutter|^2 is scr_db exactly, per pulse, for every definition (the other two need maps: radar/rvmap/scr.h
// rescales). clutter.level nrl: mean power sigma0 A / (4 pi), A the area of the range window. response: sampled by
// interval_sampling(train, ...).
// Streams kClutter, kClutterPlace and kNoise of (seed, index), kTexture of (seed, scene.texture_key). Throws InputError
// for a target without power.
Echo synthesise_echo(const PulseTrain& train, const FrequencyResponse& response, const ClutterSpec& clutter,
                     std::uint64_t seed, std::uint64_t index, const ClutterScene& scene = {});

}  // namespace seaglint

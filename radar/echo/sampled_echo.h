// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Time-domain samples of the echo, and the inverse conversion to frequencies.

#include <vector>

#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/linear.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Complex samples of every pulse after mixing with its carrier. A point of scattering amplitude a returns the
// transmitted chirp times a.
struct SampledEcho {
  double sampling_hz = 0;
  std::vector<double> time_s;  // of the samples; 0 = arrival of the middle of the pulse from the reference point
  int pulses = 0;
  std::vector<Complex> values;  // metres, [pulse][sample]

  std::size_t samples() const { return time_s.size(); }
};

// The same pulses on a frequency grid refined by an odd integer, so that pulse and range window fit into one period of
// the samples and every frequency of the coarse grid is on the fine grid. Throws InputError when radar.sampling_mhz is
// not an integer multiple of any such step, up to four times the smallest refinement, with the nearest rates that are.
PulseTrain train_for_samples(const PulseTrain& train, const RadarSpec& radar);

// Samples in one period of the grid of `fine`; 0 when sampling_hz is not an integer multiple of its step.
double samples_per_pulse(const PulseTrain& fine, double sampling_hz);

// y_n(t) = integral of Y_n(f) e^{+j 2 pi f t} df / sqrt(mu), Y on the grid of `fine`, [pulse][frequency].
SampledEcho sample_echo(const std::vector<Complex>& echo, const PulseTrain& fine, double sampling_hz);

// Y_n(f) = sqrt(mu) / fs sum_k y_n(t_k) e^{-j 2 pi f t_k} at the frequencies of `train` (as P(f),
// radar/waveform/README.md), whose step is an odd multiple of 1 / (period of the samples).
std::vector<Complex> spectrum_of(const SampledEcho& sampled, const PulseTrain& train);

}  // namespace seaglint

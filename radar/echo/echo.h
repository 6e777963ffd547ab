// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The echo of an interval in the frequency domain, Y_n(f) = P(f) H(f_n + f; attitude at t_n) + clutter + noise, with
// the thermal noise of the receiver in its units, and its samples over time.

#include <cstdint>
#include <span>
#include <vector>

#include "radar/echo/sea_clutter.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/numbers/linear.h"
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

// Throws InputError for a target whose response has no power.
void require_power(const FrequencyResponse& target);

// Echo of the target with sea clutter and noise. clutter.level scr: the clutter is scaled so that mean |target|^2 over
// mean |clutter|^2 is scr_db exactly, per pulse, for every definition (the other two need maps: radar/rvmap/rv_map.h
// rescales). An absolute level: mean power sigma0 A / (4 pi) times that of the chirp spectrum, A the area of the range
// window. response: sampled by interval_sampling(train, ...). Streams kClutter, kClutterPlace and kNoise of (seed,
// index), kTexture of (seed, scene.texture_key). Throws InputError for a target without power when a level is relative
// to it.
Echo synthesise_echo(const PulseTrain& train, const FrequencyResponse& response, const ClutterSpec& clutter,
                     std::uint64_t seed, std::uint64_t index, const ClutterScene& scene = {});

// Mean |noise|^2 of one frequency of one pulse, m^2, in the scale in which a target of scattering amplitude a has |Y| =
// a. Radar equation (Richards, Scheer and Holm, "Principles of Modern Radar", vol. 1 (2010), chapter 2) with sigma = 4
// pi a^2: energy of a pulse E = P T_p G^2 lambda^2 sigma / ((4 pi)^3 R^4 L) against N_0 = k T F. The coherent sum of
// the F frequencies of a pulse has the matched-filter ratio E / N_0, so noise^2 = F a^2 N_0 / E.
double thermal_noise_m2(const PulseTrain& train, const RadarSpec& radar);

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

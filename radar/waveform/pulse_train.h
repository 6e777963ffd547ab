// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The frequency-agile LFM pulse train of one coherent interval.

#include <cstdint>
#include <string>
#include <vector>

#include "sim/core/linear.h"
#include "sim/scattering/frequency_response.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct PulseTrain {
  std::vector<int> code;            // C_n in 0..M-1, one per pulse
  std::vector<double> carrier_hz;   // f_n = f_0 + C_n df
  std::vector<double> time_s;       // t_n = n T_r, from the interval's start
  int carriers = 1;                 // M
  double first_carrier_hz = 0;      // f_0
  double hop_step_hz = 0;           // df
  double bandwidth_hz = 0;          // B
  double chirp_rate_hz_s = 0;       // mu = B / T_p
  double pri_s = 0;
  std::vector<double> baseband_hz;  // uniform grid inside |f| <= B/2, symmetric about 0, step divides df
  double baseband_step_hz = 0;
  std::vector<Complex> chirp_spectrum;  // P(f) on baseband_hz: THE transmit waveform

  double unambiguous_range_m() const;  // c / (2 baseband_step): the window without wrap
  double range_resolution_m() const;   // c / (2 M df)
  double velocity_resolution_mps() const;  // lambda / (2 N T_r), lambda at the band's centre
  double unambiguous_velocity_mps() const;  // lambda / (4 T_r): the span is +- this
};

// range_window_m: the response's extent plus margin; the baseband step is df / ceil(df 2 window / c). Stream kHopCode of (seed, index).
PulseTrain make_pulse_train(const RadarSpec& spec, double range_window_m, std::uint64_t seed, std::uint64_t index);

// Where the pulse train asks for the target's response in an interval that starts at start_s.
IntervalSampling interval_sampling(const PulseTrain& train, double start_s);

// Resolutions, ambiguities, blind range and expected pedestal, one line each, for `seaglint check`.
std::string describe(const PulseTrain& train, const RadarSpec& spec);

}  // namespace seaglint

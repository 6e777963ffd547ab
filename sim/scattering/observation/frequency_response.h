// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Interface between the electromagnetic solver and the signal processing: sampling of an interval and the response H.

#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Sampling of the response over a coherent interval. All frequencies lie on one uniform grid first_hz + i step_hz, i =
// 0..count-1; pulse n uses the frequencies_per_pulse frequencies from i = pulse_first[n] on.
struct IntervalSampling {
  double first_hz = 0;
  double step_hz = 0;
  int count = 0;
  int frequencies_per_pulse = 0;
  std::vector<int> pulse_first;
  std::vector<double> pulse_time_s;  // ascending, time of the trajectory
  // Chirp: a baseband frequency f (0 at the middle of the pulse's frequencies) is scattered at pulse_time + f /
  // chirp_rate. 0: stop and go, one attitude per pulse.
  double chirp_rate_hz_s = 0;
  // Velocity of the radar over its range, 1/s, target frame: the look direction at time t is that of r^ + (t - first
  // pulse's time) line_of_sight_rate. 0: fixed radar.
  Vec3 line_of_sight_rate = Vec3::Zero();
};

// H of one polarisation, m, signs of CONVENTIONS.md; values[n * frequencies_per_pulse + b]: pulse n, its b-th
// frequency.
struct FrequencyResponse {
  int pulses = 0;
  int frequencies_per_pulse = 0;
  std::vector<Complex> values;

  Complex& at(int pulse, int b) { return values[static_cast<std::size_t>(pulse) * frequencies_per_pulse + b]; }
  const Complex& at(int pulse, int b) const {
    return values[static_cast<std::size_t>(pulse) * frequencies_per_pulse + b];
  }
};

// Sum of the responses of several bodies; shapes must be equal.
FrequencyResponse& operator+=(FrequencyResponse& sum, const FrequencyResponse& term);

}  // namespace seaglint

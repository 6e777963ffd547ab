// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The narrow waist: left of it is physics, right of it is signal processing.

#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Where a coherent interval samples the response. Frequencies of all pulses lie on one uniform grid first_hz + i
// step_hz, i = 0..count-1; pulse n uses the frequencies_per_pulse frequencies that begin at i = pulse_first[n].
struct IntervalSampling {
  double first_hz = 0;
  double step_hz = 0;
  int count = 0;
  int frequencies_per_pulse = 0;
  std::vector<int> pulse_first;
  std::vector<double> pulse_time_s;  // ascending, absolute time in the trajectory
  // Not 0: the pulse sweeps, and its baseband frequency f (0 in the middle of its frequencies) meets the target at
  // pulse_time + f / chirp_rate. 0: stop and go, the whole pulse meets the attitude at pulse_time.
  double chirp_rate_hz_s = 0;
  // The radar's velocity over its range, 1/s, target frame: the direction to it turns from r^ to that of r^ + (t -
  // first pulse's time) line_of_sight_rate. 0: the radar stands.
  Vec3 line_of_sight_rate = Vec3::Zero();
};

// H of one polarisation in metres, CONVENTIONS.md signs; values[n * frequencies_per_pulse + b] for pulse n and its b-th
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

// Sum of the responses of several bodies (equal shapes).
FrequencyResponse& operator+=(FrequencyResponse& sum, const FrequencyResponse& term);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Intervals of a moving radar, whose direction and image in the sea change over the pulses.

#include <array>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/observation/sea_reflection.h"

namespace seaglint::testing_moving_radar {

inline constexpr double kRange = 20e3;
inline const Vec3 kVelocity(40, 220, -15);  // a passing aircraft

inline IntervalSampling interval() {
  IntervalSampling sampling;
  sampling.first_hz = 16e9;
  sampling.step_hz = 5e6;
  sampling.count = 40;
  sampling.frequencies_per_pulse = 40;
  for (int n = 0; n < 16; ++n) {
    sampling.pulse_first.push_back(0);
    sampling.pulse_time_s.push_back(3 + 4e-3 * n);
  }
  sampling.line_of_sight_rate = kVelocity / kRange;
  return sampling;
}

// Over the sea the path lengths are r^.x or r'.x at the direction of the radar's true position, r' with r_z negated:
// for a radar that approaches in level flight, climbs or passes the image moves in the opposite sense.
inline constexpr double kNearRange = 4e3;
inline const std::array<Vec3, 4> kVelocities{Vec3(-300, 0, 0), Vec3(0, 0, 100), Vec3(0, 100, 0), Vec3(-200, 80, -30)};

inline IntervalSampling over_the_sea(const Vec3& velocity) {
  IntervalSampling sampling = interval();
  sampling.line_of_sight_rate = velocity / kNearRange;
  return sampling;
}

inline Vec3 direction_at(const IntervalSampling& sampling, const Vec3& r_hat, std::size_t pulse) {
  const double t = sampling.pulse_time_s[pulse] - sampling.pulse_time_s.front();
  return (r_hat + t * sampling.line_of_sight_rate).normalized();
}

// Waves that halve the specular reflection.
inline SeaReflection rough_water() { return SeaReflection(SeaReflectionSpec{}, 0.1); }

}  // namespace seaglint::testing_moving_radar

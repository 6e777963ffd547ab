// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Slow random rotation of a float about the vertical.

#include <cstdint>
#include <vector>

#include "sim/motion/kinematics/oscillator.h"

namespace seaglint {

// Sum of kYawHarmonics cosines of equal variance, whose rate has the spectrum of an Ornstein-Uhlenbeck process of
// correlation time kYawCorrelationTime; smooth and independent of the time step. Without a spring (period = 0) the
// heading at t = 0 is uniform; with one each harmonic is filtered by the oscillator of the spring and the mean heading
// is 0. rate = 0: heading 0.
inline constexpr int kYawHarmonics = 64;
inline constexpr double kYawCorrelationTime = 10;  // s

class RandomYaw {
 public:
  // rate: standard deviation, rad/s.
  RandomYaw(double rate, double period, double damping, std::uint64_t seed, std::uint64_t index);

  OscillatorState at(double t) const;

 private:
  double heading_ = 0;
  std::vector<double> omega_, phase_, amplitude_;  // amplitude_ of the rate
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The slow random rotation of a float about the vertical.

#include <cstdint>
#include <vector>

#include "sim/motion/kinematics/oscillator.h"

namespace seaglint {

// A slow random rotation: a sum of kYawHarmonics cosines that share the variance of the rate equally, with the
// frequencies of an Ornstein-Uhlenbeck process of correlation time kYawCorrelationTime; smooth, and the same for any
// time step. Without a spring the heading at t = 0 is uniform; with one (period > 0) each harmonic passes through the
// spring's oscillator and the mean heading is 0. A rate of 0 leaves the float at heading 0.
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

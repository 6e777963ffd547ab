// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Statistics and spectra of how a body turns in the waves.

#include <array>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"

namespace seaglint {

inline constexpr double kStatisticsStep_s = 0.1;  // between the samples that are counted

// Every kStatisticsStep_s over [0, duration_s] or to the trajectory's end.
std::vector<MotionSample> uniform_samples(const Trajectory& trajectory, double duration_s);

struct AngleStatistics {
  double mean = 0;           // rad
  double rms = 0;            // about the mean, rad
  double largest = 0;        // modulus, rad
  double mean_period_s = 0;  // between zero crossings, 2 pi rms / rms of the rate; 0 where the angle stays
};

// Of roll, pitch and yaw over [0, duration_s].
std::array<AngleStatistics, 3> angle_statistics(const Trajectory& trajectory, double duration_s);

struct AngleSpectra {
  std::vector<double> omega;                   // rad/s, every half of a window's resolution up to 8
  std::array<std::vector<double>, 3> density;  // one-sided, of roll, pitch and yaw, rad^2 s/rad
};

// The mean over half-overlapping Hann windows of 120 s (or of the whole duration, when shorter), each less its mean.
AngleSpectra angle_spectra(const Trajectory& trajectory, double duration_s);

}  // namespace seaglint

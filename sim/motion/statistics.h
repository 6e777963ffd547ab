// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Statistics and spectra of the angular motion of a body.

#include <array>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"

namespace seaglint {

inline constexpr double kStatisticsStep_s = 0.1;  // sampling step of the statistics

// Samples every kStatisticsStep_s over [0, duration_s] or to the end of the trajectory.
std::vector<MotionSample> uniform_samples(const Trajectory& trajectory, double duration_s);

struct AngleStatistics {
  double mean = 0;           // rad
  double rms = 0;            // about the mean, rad
  double largest = 0;        // modulus, rad
  double mean_period_s = 0;  // between zero crossings, 2 pi rms / rms of the rate; 0 for a constant angle
};

// Of roll, pitch and yaw over [0, duration_s].
std::array<AngleStatistics, 3> angle_statistics(const Trajectory& trajectory, double duration_s);

inline constexpr std::array<const char*, 6> kDegreesOfFreedom{"roll", "pitch", "yaw", "surge", "sway", "heave"};

// Root mean square about the mean of roll, pitch, yaw (rad), surge, sway, heave (m) over [0, duration_s]; exactly 0 in
// a degree of freedom that stays within 1e-9 of its first value.
std::array<double, 6> motion_rms(const Trajectory& trajectory, double duration_s);

struct AngleSpectra {
  std::vector<double> omega;                   // rad/s, in steps of half the resolution of a window, up to 8
  std::array<std::vector<double>, 3> density;  // one-sided, of roll, pitch and yaw, rad^2 s/rad
};

// Welch's method: mean over half-overlapping Hann windows of 120 s (or the whole duration, if shorter), the mean of
// each removed.
AngleSpectra angle_spectra(const Trajectory& trajectory, double duration_s);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Measured or simulated motion time series, read from files of this and other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"

namespace seaglint {

// Angles (rad) and translations (m) in the conventions of this project at ascending times; rates are those of the cubic
// spline through them.
struct AttitudeSeries {
  std::string source;
  std::vector<double> time;
  std::vector<MotionSample> samples;
};

// Reads a motion time series. The format is detected from the contents:
// - own: CSV `time_s,roll_deg,pitch_deg,yaw_deg[,surge_m,sway_m,heave_m]`, or angles as `roll_rad` and so on;
// - DualSPHysics FloatingInfo: `;`, `time [s]`, `roll [deg]`; the sign of pitch, which differs between versions,
//   follows the angular velocity `fomega.y [rad/s]` (without that column: right-handed);
// - OpenFAST text output: `Time`, `PtfmRoll` and so on, in the units of its own line.
// All have x forward, y to port and z up. Jumps of a full turn in yaw are removed.
// Throws InputError with file and line for missing columns, cells that are not finite numbers, times that do not
// increase, gaps (a step of ten times the usual), degrees where radians are declared, and a change of unit within the
// file.
AttitudeSeries read_attitude_series(const std::filesystem::path& file);

// The series as a trajectory whose t = 0 is the time start_s of the series; translations = false sets the translations
// to zero. Uniform times are kept and joined by the spline; others are resampled from the spline at their smallest
// step, so that above the Nyquist frequency of the series there are only the images of the cubic spline.
// Throws InputError when the series does not cover start_s to start_s + duration_s.
Trajectory trajectory_of(const AttitudeSeries& series, double start_s, double duration_s, bool translations,
                         const Vec3& rest_position, const Vec3& rotation_centre);

}  // namespace seaglint

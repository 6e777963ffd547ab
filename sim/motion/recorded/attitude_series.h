// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Measured or simulated motion in time, read from files of this and other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"

namespace seaglint {

// Angles (rad) and shifts (m) in this project's conventions at ascending times; rates are those of the cubic spline
// through them.
struct AttitudeSeries {
  std::string source;
  std::vector<double> time;
  std::vector<MotionSample> samples;
};

// Which of these it is, is told by the file itself:
// - own: CSV `time_s,roll_deg,pitch_deg,yaw_deg[,surge_m,sway_m,heave_m]`, or angles as `roll_rad` and so on;
// - DualSPHysics FloatingInfo: `;`, `time [s]`, `roll [deg]`; its pitch changed sign between versions, so it is taken
// as
//   the angular velocity `fomega.y [rad/s]` beside it says (without one: right-handed);
// - OpenFAST text output: `Time`, `PtfmRoll` and so on, in the units of its own line.
// All have x forward, y to port and z up. Steps of a whole turn in yaw are taken out.
// Throws InputError with file and line for missing columns, cells that are no finite number, times that do not grow,
// gaps (a step ten times the usual), degrees where radians are declared, and a change of unit within the file.
AttitudeSeries read_attitude_series(const std::filesystem::path& file);

// The series as a trajectory whose t = 0 is the series' time start_s; translations off leaves the shifts out. Uniform
// times are kept as they stand, joined by the spline; others are read off the spline at their smallest step. So nothing
// is added above the series' own Nyquist frequency but what a cubic spline makes of it.
// Throws InputError when the series does not last from start_s to start_s + duration_s.
Trajectory trajectory_of(const AttitudeSeries& series, double start_s, double duration_s, bool translations,
                         const Vec3& rest_position, const Vec3& rotation_centre);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Measured or simulated motion time series, read from files of this and other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Times of a file: uniform to a thousandth of a step, rounded values of uniform ones, or neither.
enum class TimeGrid { kUniform, kRounded, kIrregular };

// Replaces ascending times, at least two, that all lie within `rounding` of one uniform grid by the uniform grid from
// the first to the last; leaves others. Rounding above 0.35 of the step leaves irregular times indistinguishable from
// uniform ones, and counts as irregular.
TimeGrid make_uniform(std::vector<double>& time, double rounding);

// Angles (rad) and translations (m) in the conventions of this project at ascending times; rates are those of the cubic
// spline through them.
struct AttitudeSeries {
  std::string source;
  std::vector<double> time;
  std::vector<MotionSample> samples;
  std::string reading{};  // columns, units and times as they were understood, for users
  TimeGrid grid = TimeGrid::kUniform;
};

// How a series is read: keys of a MotionSpec.
struct SeriesRules {
  bool translations = true;
  MeanRule heading = MeanRule::kAuto;
  MeanRule position = MeanRule::kAuto;
};

// Beyond these means a series is taken as given in another frame than T (README.md, "Means").
inline constexpr double kLargestHeading_deg = 5, kLargestDistance_m = 100, kLargestHeave_m = 10;

// Reads a motion time series: a table (sim/core/text/text_table.h) with columns by name, of
// - this project: `time_s`, `roll_deg` or `roll_rad`, `pitch_...`, and as far as given `yaw_...`, `surge_m`, `sway_m`,
//   `heave_m`; the others are 0;
// - DualSPHysics FloatingInfo: `time [s]`, `roll [deg]`; the sign of pitch, which differs between versions, follows the
//   angular velocity `fomega.y [rad/s]` (without that column: right-handed);
// - OpenFAST text output: `Time`, `PtfmRoll` and so on, in the units of its own line.
// All have x forward, y to port and z up. Jumps of a full turn in yaw are removed. Times that all lie within half of
// their last decimal of one uniform grid become that grid, from the first time to the last.
// The circular mean of yaw over the whole file is removed, and surge and sway turned with it, where it exceeds
// kLargestHeading_deg; a yaw that turns so far that the mean of its unit vectors is shorter than 1/2 has none. The
// means of surge and sway are removed where their distance exceeds kLargestDistance_m, that of heave beyond
// kLargestHeave_m. Means are over time, by the trapezoidal rule. Throws InputError with file, line and column for
// missing columns, cells that are not finite numbers, times that do not increase, gaps (a step of ten times the usual),
// degrees where radians are declared, and a change of unit within the file.
AttitudeSeries read_attitude_series(const std::filesystem::path& file, const SeriesRules& rules = {});

// The series as a trajectory whose t = 0 is the time start_s of the series; translations = false sets the translations
// to zero. Uniform times are kept and joined by the spline; others are resampled from the spline at their smallest
// step, so that above the Nyquist frequency of the series there are only the images of the cubic spline.
// Throws InputError when the series does not cover start_s to start_s + duration_s.
Trajectory trajectory_of(const AttitudeSeries& series, double start_s, double duration_s, bool translations,
                         const Vec3& rest_position, const Vec3& rotation_centre);

}  // namespace seaglint

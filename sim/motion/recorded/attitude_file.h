// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// File formats of motion time series: columns, units and signs.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/text/text_table.h"
#include "sim/motion/kinematics/trajectory.h"

namespace seaglint {

// Columns of the table.
inline constexpr std::size_t kTimeColumn = 0, kFirstAngleColumn = 1;  // then roll, pitch, yaw
inline constexpr std::size_t kFirstShiftColumn = 4;                   // then surge, sway, heave

// Rows of the file: angles in rad and translations in m, in the conventions of this project.
struct AttitudeTable {
  TextTable table;
  std::vector<double> time;
  std::vector<MotionSample> samples;
  bool pitch_reversed = false;  // so that it agrees with the angular velocity of the file

  bool in_radians(std::size_t axis) const;  // roll, pitch or yaw, as the file declares
};

// Formats: attitude_series.h. Degrees of freedom that the table does not have are 0. `translations`: surge, sway and
// heave are needed, in metres. Throws InputError with file, line and column.
AttitudeTable read_attitude_table(const std::filesystem::path& file, bool translations);

}  // namespace seaglint

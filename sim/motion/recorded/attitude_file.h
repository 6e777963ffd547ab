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

// Rows of the file: angles in rad and translations in m, in the conventions of this project.
struct AttitudeTable {
  TextTable table;
  std::vector<double> time;
  std::vector<MotionSample> samples;
  bool pitch_reversed = false;  // so that it agrees with the angular velocity of the file

  bool in_radians(std::size_t axis) const;  // roll, pitch or yaw, as the file declares
};

// Formats: attitude_series.h. Throws InputError with file, line and column.
AttitudeTable read_attitude_table(const std::filesystem::path& file);

}  // namespace seaglint

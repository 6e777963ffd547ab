// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// File formats of motion time series: columns, units and signs.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"

namespace seaglint {

// Rows of the file: angles in rad and translations in m, in the conventions of this project.
struct AttitudeTable {
  std::string file;
  std::vector<int> lines;
  std::vector<double> time;
  std::vector<MotionSample> samples;
  bool in_degrees = true;  // as the file declares

  std::string place(std::size_t row) const;  // "FILE:LINE"
};

// Formats: attitude_series.h. Throws InputError with file and line.
AttitudeTable read_attitude_table(const std::filesystem::path& file);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The formats of motion series: where their columns stand, their units and signs.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/motion/kinematics/trajectory.h"

namespace seaglint {

// Angles in rad and shifts in m in this project's conventions, as they stand in the file.
struct AttitudeTable {
  std::string file;
  std::vector<int> lines;
  std::vector<double> time;
  std::vector<MotionSample> samples;
  bool in_degrees = true;  // as the file declares

  std::string place(std::size_t row) const;  // "FILE:LINE"
};

// The formats are told in attitude_series.h. Throws InputError with file and line.
AttitudeTable read_attitude_table(const std::filesystem::path& file);

}  // namespace seaglint

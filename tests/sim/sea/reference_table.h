// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A sea state of the tests, and the numeric tables of tests/reference/waves.

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/scenario/sea_spec.h"

namespace seaglint {

// A long-crested JONSWAP sea in deep water with the default cut-offs; height in m, period in s.
inline SeaState state_of(double height, double period) {
  SeaState state;
  state.significant_wave_height_m = height;
  state.peak_period_s = period;
  state.cutoff_rad_s = 0;
  state.second_order_cutoff_rad_s = 0;
  return state;
}

// Rows of a comma-separated file below its header; a cell that is not a number reads as 0.
inline std::vector<std::vector<double>> read_reference(const std::string& name) {
  std::ifstream file(SEAGLINT_SOURCE_DIR "/tests/reference/waves/" + name);
  if (!file) throw std::runtime_error("no " + name);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::strtod(cell.c_str(), nullptr));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace seaglint

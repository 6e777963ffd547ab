// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reads the numeric tables of tests/reference/waves.

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace seaglint {

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

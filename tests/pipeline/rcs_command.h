// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// `seaglint rcs` on a plate, and the table that it writes.

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/pipeline/program.h"

namespace seaglint {

inline constexpr double kLengthM = 0.5, kWidthM = 0.3;

// A folder with plate.glb, as the program makes it.
class RcsCommand : public testing::Test {
 protected:
  void SetUp() override {
    const ProgramResult made =
        run_program({"mesh", "make", "plate", "--length-m", "0.5", "--width-m", "0.3", "-o", plate()});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  std::string plate() const { return folder_.path() / "plate.glb"; }
  std::string table() const { return folder_.path() / "rcs.csv"; }
  ProgramResult rcs(std::vector<std::string> more) const {
    more.insert(more.begin(), {"rcs", "--target", plate(), "-o", table()});
    return run_program(more);
  }

  TemporaryFolder folder_;
};

struct CsvTable {
  std::string header;
  std::vector<std::vector<double>> rows;
};

inline CsvTable read_table(const std::string& file) {
  CsvTable table;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    if (table.header.empty()) {
      table.header = line;
      continue;
    }
    std::istringstream cells(line);
    table.rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) table.rows.back().push_back(std::stod(cell));
  }
  return table;
}

}  // namespace seaglint

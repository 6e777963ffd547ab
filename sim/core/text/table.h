// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tables of numbers in text files.

#include <filesystem>
#include <string>
#include <vector>

namespace seaglint {

// Named columns of finite numbers, with the file line of each row.
class Table {
 public:
  Table(std::string file, std::vector<std::string> names, std::vector<std::vector<double>> cells,
        std::vector<int> lines);

  std::size_t rows() const { return cells_.size(); }
  double at(std::size_t row, std::size_t column) const { return cells_[row][column]; }
  const std::vector<std::string>& names() const { return names_; }
  int line(std::size_t row) const { return lines_[row]; }
  // "FILE:LINE" of a row.
  std::string place(std::size_t row) const;

  // Throws InputError unless the values of the column increase strictly.
  void check_ascending(const std::string& name) const;
  // Throws InputError unless lowest <= value <= highest.
  void check_within(std::size_t row, std::size_t column, double lowest, double highest) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> cells_;
  std::vector<int> lines_;
};

// Layout of a table: comments ('#') and empty lines, a line of column names, the given number of unit lines, then rows.
// Separator ' ' means spaces and tabs.
struct TableLayout {
  char separator = ',';
  int unit_lines = 0;
};

// Reads the requested columns, in this order; other columns are ignored; at least two rows. Throws InputError with
// file, line and column for a missing column, a row of another length, and a cell that is not a finite number.
Table read_table(const std::filesystem::path& file, const std::vector<std::string>& requested, TableLayout layout = {});

// The same for a text whose column names are in the given line (1-based).
Table parse_table(const std::string& text, const std::string& file, const std::vector<std::string>& requested,
                  TableLayout layout, int names_line = 0);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/number.h"
#include "sim/core/text/words.h"

namespace seaglint {

Table::Table(std::string file, std::vector<std::string> names, std::vector<std::vector<double>> cells,
             std::vector<int> lines)
    : file_(std::move(file)), names_(std::move(names)), cells_(std::move(cells)), lines_(std::move(lines)) {}

std::string Table::place(std::size_t row) const { return fmt::format("{}:{}", file_, lines_[row]); }

void Table::check_ascending(const std::string& name) const {
  const auto column = static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
  for (std::size_t row = 1; row < rows(); ++row) {
    if (!(at(row, column) > at(row - 1, column))) {
      throw InputError(fmt::format("{}: {}: value {}: must be greater than {} of line {}", place(row), name,
                                   at(row, column), at(row - 1, column), lines_[row - 1]));
    }
  }
}

void Table::check_within(std::size_t row, std::size_t column, double lowest, double highest) const {
  if (at(row, column) >= lowest && at(row, column) <= highest) return;
  throw InputError(fmt::format("{}: {}: value {}: must be within {} and {}", place(row), names_[column],
                               at(row, column), lowest, highest));
}

namespace {

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  if (separator == ' ') {
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) cells.push_back(word);
    return cells;
  }
  while (true) {
    const auto end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  // Some programs end every line with the separator.
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

// Index of each requested column among those of the file.
std::vector<std::size_t> find_columns(const std::vector<std::string_view>& names,
                                      const std::vector<std::string>& requested, const std::string& place) {
  std::vector<std::size_t> columns;
  for (const std::string& name : requested) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      throw InputError(fmt::format("{}: no column {}; the columns are {}", place, name, fmt::join(names, ", ")));
    }
    columns.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return columns;
}

}  // namespace

Table parse_table(const std::string& text, const std::string& file, const std::vector<std::string>& requested,
                  TableLayout layout, int names_line) {
  std::string_view rest = text;
  std::vector<std::size_t> columns;
  std::size_t width = 0;
  std::vector<std::vector<double>> cells;
  std::vector<int> lines;
  int units = layout.unit_lines;
  int number = 0;
  while (!rest.empty()) {
    const std::string_view line = trimmed(next_line(rest));
    ++number;
    if (number < names_line || line.empty() || line.front() == '#') continue;
    const std::vector<std::string_view> words = split(line, layout.separator);
    if (columns.empty()) {
      columns = find_columns(words, requested, fmt::format("{}:{}", file, number));
      width = words.size();
      continue;
    }
    if (units > 0) {
      --units;
      continue;
    }
    if (words.size() != width) {
      throw InputError(fmt::format("{}:{}: {} cells where the names are {}", file, number, words.size(), width));
    }
    std::vector<double>& row = cells.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::optional<double> value = parse_number(words[columns[i]]);
      if (!value) {
        throw InputError(fmt::format("{}:{}:{}: {}: value '{}': must be a finite number", file, number,
                                     words[columns[i]].data() - line.data() + 1, requested[i], words[columns[i]]));
      }
      row.push_back(*value);
    }
    lines.push_back(number);
  }
  if (cells.size() < 2) {
    throw InputError(fmt::format("{}: {} rows of numbers below the names: must be at least 2", file, cells.size()));
  }
  return Table(file, requested, std::move(cells), std::move(lines));
}

Table read_table(const std::filesystem::path& file, const std::vector<std::string>& requested, TableLayout layout) {
  return parse_table(read_file(file), file.string(), requested, layout);
}

}  // namespace seaglint

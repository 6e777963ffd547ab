// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/escape.h"

#include <algorithm>
#include <cstddef>

#include "sim/core/process/printable.h"

namespace seaglint {

std::string csv_cell(std::string_view text) {
  std::string cell = on_one_line(text);
  const std::size_t first = cell.find_first_not_of(' ');
  if (first != std::string::npos && std::string_view("=+-@").find(cell[first]) != std::string_view::npos)
    cell.insert(0, 1, '\'');
  const bool outer_blanks = !cell.empty() && (cell.front() == ' ' || cell.back() == ' ');
  if (cell.find_first_of(",\";#") == std::string::npos && !outer_blanks) return cell;
  std::string quoted = "\"";
  for (const char c : cell) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string markdown_text(std::string_view text) {
  constexpr std::string_view kStructure = "\\`*[]<>|&~#";
  std::string escaped;
  for (const char c : on_one_line(text)) {
    if (kStructure.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string markdown_code(std::string_view text) {
  // A fence longer than any run of backquotes inside (CommonMark 0.31, section 6.1).
  const std::string line = on_one_line(text);
  std::size_t longest = 0, run = 0;
  for (const char c : line) longest = std::max(longest, run = c == '`' ? run + 1 : 0);
  const std::string fence(longest + 1, '`');
  const std::string_view gap = longest > 0 ? " " : "";
  return fence + std::string(gap) + line + std::string(gap) + fence;
}

}  // namespace seaglint

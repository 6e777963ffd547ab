// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/text_rows.h"

#include <algorithm>

#include "sim/core/text/words.h"

namespace seaglint {
namespace {

constexpr std::size_t kLongestQuoted = 65536;  // bytes

// Length of the text in quotes at the front of `text`, whose first character is the quote; npos without an end.
std::size_t quoted_length(std::string_view text) {
  text = text.substr(0, kLongestQuoted);
  for (std::size_t end = text.find('"', 1); end != std::string_view::npos; end = text.find('"', end + 2)) {
    if (end + 1 >= text.size() || text[end + 1] != '"') return end - 1;
  }
  return std::string_view::npos;
}

void skip_blanks(std::string_view& rest, char separator) {
  while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\r' || rest.front() == '\f' ||
                           (rest.front() == '\t' && separator != '\t'))) {
    rest.remove_prefix(1);
  }
}

bool ends_cell(std::string_view rest, char separator) {
  if (rest.empty() || rest.front() == '\n' || rest.front() == separator) return true;
  return separator == ' ' && (rest.front() == '\t' || rest.front() == '\r');
}

}  // namespace

TextRow next_row(std::string_view& rest, char separator) {
  TextRow row;
  next_row(rest, separator, row);
  return row;
}

void next_row(std::string_view& rest, char separator, TextRow& row) {
  row.cells.clear();
  row.open_quote = {};
  while (true) {
    skip_blanks(rest, separator);
    const bool at_end = rest.empty() || rest.front() == '\n';
    if (at_end && (separator == ' ' || row.cells.empty())) break;
    std::string_view cell;
    if (rest.starts_with('"')) {
      const std::string_view open = rest.substr(0, 1);
      const std::size_t length = quoted_length(rest);
      if (length != std::string_view::npos) {
        cell = rest.substr(1, length);
        rest.remove_prefix(length + 2);
        if (separator != ' ') skip_blanks(rest, separator);
      }
      if (length == std::string_view::npos || !ends_cell(rest, separator)) {
        row.open_quote = open;
        next_line(rest);
        return;
      }
    } else {
      std::size_t end = 0;
      while (!ends_cell(rest.substr(end), separator)) ++end;
      cell = trimmed(rest.substr(0, end));
      rest.remove_prefix(end);
    }
    row.cells.push_back(cell);
    if (separator == ' ') continue;
    if (rest.empty() || rest.front() == '\n') break;
    rest.remove_prefix(1);
    // A separator at the very end is followed by one more, empty cell.
    skip_blanks(rest, separator);
    if (rest.empty() || rest.front() == '\n') {
      row.cells.push_back(rest.substr(0, 0));
      break;
    }
  }
  if (!rest.empty()) rest.remove_prefix(1);
}

bool is_rule(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.size() >= 3 && text.find_first_not_of("-=_*+| \t") == std::string_view::npos;
}

bool is_empty(std::span<const std::string_view> cells) {
  return std::all_of(cells.begin(), cells.end(), [](std::string_view cell) { return cell.empty(); });
}

}  // namespace seaglint

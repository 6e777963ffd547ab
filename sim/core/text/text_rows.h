// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rows of text tables as cells.

#include <span>
#include <string_view>
#include <vector>

namespace seaglint {

// Separators of tables, in the order in which they are tried; ' ' means spaces and tabs.
inline constexpr char kSeparators[] = {';', '\t', ',', ' '};

struct TextRow {
  std::vector<std::string_view> cells;  // without blanks around them and without quotes
  std::string_view open_quote;          // a quote that is not closed, or that other text follows; empty: none
};

// The next row, removed from the front of `rest`. A cell in double quotes (RFC 4180) may contain separators and line
// ends; "" in it stands for a quote and is left so.
TextRow next_row(std::string_view& rest, char separator);
// The same into a row, whose memory is used again.
void next_row(std::string_view& rest, char separator, TextRow& row);

// A line that separates parts of a table: at least three of - = _ * + and |, with blanks.
bool is_rule(std::string_view line);

// No cell contains anything.
bool is_empty(std::span<const std::string_view> cells);

}  // namespace seaglint

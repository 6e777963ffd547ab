// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/rows/first_rows.h"

#include <algorithm>

#include "sim/core/text/column_key.h"
#include "sim/core/text/text_rows.h"
#include "sim/core/text/words.h"

namespace seaglint {

bool FirstRow::has(std::string_view key) const { return std::find(keys.begin(), keys.end(), key) != keys.end(); }

std::vector<FirstRow> first_rows(const TextSource& source, bool in_comments) {
  constexpr int kMaxLines = 20;
  std::vector<FirstRow> rows;
  std::string_view rest = source.text();
  for (int n = 0; n < kMaxLines && !rest.empty();) {
    std::string_view text = rest;
    const std::string_view line = next_line(rest);
    if (trimmed(line).empty() || is_comment(line) != in_comments) continue;
    ++n;
    if (in_comments) text = line.substr(std::min(line.find_first_not_of(" \t#%/!"), line.size()));
    for (const char separator : kSeparators) {
      std::string_view row = text;
      FirstRow first{next_row(row, separator).cells, {}};
      for (const std::string_view cell : first.cells) first.keys.push_back(column_key(cell));
      rows.push_back(std::move(first));
    }
  }
  return rows;
}

}  // namespace seaglint

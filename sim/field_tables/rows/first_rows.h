// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The first rows of a text with each separator, by which formats are recognised.

#include <string>
#include <string_view>
#include <vector>

#include "sim/core/text/text_source.h"

namespace seaglint {

struct FirstRow {
  std::vector<std::string_view> cells;
  std::vector<std::string> keys;  // column_key() of each

  bool has(std::string_view key) const;
};

// Rows that begin in the first 20 lines that are neither empty nor comments, or that are comments, cut at each
// separator in turn.
std::vector<FirstRow> first_rows(const TextSource& source, bool in_comments = false);

// Whether one of them is such a row.
template <class Is>
bool any_first_row(const TextSource& source, Is is) {
  for (const FirstRow& row : first_rows(source)) {
    if (is(row)) return true;
  }
  return false;
}

}  // namespace seaglint

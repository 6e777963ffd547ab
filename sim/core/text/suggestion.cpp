// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace seaglint {

namespace {

// Edit distance with transpositions of adjacent characters (Damerau 1964, optimal string alignment), ignoring case.
std::size_t distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string suggestion(std::string_view misspelt, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 100;  // longer words get no suggestion
  const std::size_t near = std::max<std::size_t>(1, misspelt.size() / 3);
  std::size_t best = near + 1;
  const std::string* nearest = nullptr;
  for (const std::string& name : names) {
    if (misspelt.size() > kLongest) break;
    const std::size_t d = distance(misspelt, name);
    if (d < best) {
      best = d;
      nearest = &name;
    }
  }
  if (nearest != nullptr) return fmt::format("did you mean '{}'?", *nearest);
  return fmt::format("must be one of {}", fmt::join(names, ", "));
}

}  // namespace seaglint

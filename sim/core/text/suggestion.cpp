// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

constexpr std::size_t kLongest = 100;  // longer words get no suggestion

std::size_t near_distance(std::string_view misspelt) { return std::max<std::size_t>(1, misspelt.size() / 3); }

constexpr std::array<std::string_view, 30> kUnits{
    "m",    "mm",  "cm",  "km",  "ft", "in",    "s",  "ms", "us", "ns", "hz",  "khz",   "mhz",   "ghz",   "db",
    "dbsm", "deg", "rad", "mps", "kn", "knots", "kw", "w",  "c",  "k",  "psu", "rad_s", "deg_s", "hours", "min"};

// A name without the unit at its end: "bandwidth" of "bandwidth_mhz", "--frequency" of "--frequency-ghz".
std::string_view without_unit(std::string_view name) {
  for (const std::string_view unit : kUnits) {
    if (name.size() < unit.size() + 2 || distance(name.substr(name.size() - unit.size()), unit) != 0) continue;
    const char before = name[name.size() - unit.size() - 1];
    if (before == '_' || before == '-') return name.substr(0, name.size() - unit.size() - 1);
  }
  return name;
}

// A distance and the name that has it.
struct Nearest {
  std::size_t distance = 0;
  const std::string* name = nullptr;
};

// The first of the nearest names within near_distance(); `reduced` is applied to the word and to each name.
template <typename Reduced>
Nearest nearest_of(std::string_view misspelt, const std::vector<std::string>& names, const Reduced& reduced) {
  const std::string_view word = reduced(misspelt);
  Nearest best{near_distance(word) + 1};
  for (const std::string& name : names) {
    if (misspelt.size() > kLongest) break;
    const std::size_t d = distance(word, reduced(name));
    if (d < best.distance) best = {d, &name};
  }
  return best;
}

// True if one of the words of `name`, and those behind it, begin with `part`: "sea_state" in "hh_sea_state".
bool has_words(std::string_view name, std::string_view part) {
  for (std::size_t begin = 0; begin + part.size() <= name.size(); ++begin) {
    const bool at_word = begin == 0 || std::string_view("_-.").find(name[begin - 1]) != std::string_view::npos;
    if (at_word && distance(name.substr(begin, part.size()), part) == 0) return true;
  }
  return false;
}

// Names that contain the word, or whose own words the word begins with.
std::vector<std::string_view> names_with(std::string_view misspelt, const std::vector<std::string>& names) {
  constexpr std::size_t kShortest = 3;
  const std::string_view word = without_unit(misspelt);
  std::vector<std::string_view> found;
  if (word.size() < kShortest || misspelt.size() > kLongest) return found;
  for (const std::string& name : names) {
    const std::string_view stem = without_unit(name);
    const bool begins = stem.size() > kShortest && word.size() > stem.size() &&
                        (word[stem.size()] == '_' || word[stem.size()] == '-') &&
                        distance(word.substr(0, stem.size()), stem) == 0;
    if (begins || has_words(name, word)) found.push_back(name);
  }
  return found;
}

}  // namespace

std::optional<std::string> nearest(std::string_view misspelt, const std::vector<std::string>& names) {
  const Nearest found = nearest_of(misspelt, names, [](std::string_view name) { return name; });
  return found.name == nullptr ? std::nullopt : std::optional(*found.name);
}

std::optional<std::string> near_suggestion(std::string_view misspelt, const std::vector<std::string>& names) {
  const Nearest whole = nearest_of(misspelt, names, [](std::string_view name) { return name; });
  const Nearest stem = nearest_of(misspelt, names, without_unit);
  const bool is_whole = whole.name != nullptr && (stem.name == nullptr || whole.distance <= stem.distance);
  if (const std::string* name = is_whole ? whole.name : stem.name) return fmt::format("did you mean '{}'?", *name);
  constexpr std::size_t kMost = 4;
  std::vector<std::string_view> with = names_with(misspelt, names);
  if (with.empty() || with.size() > kMost) return std::nullopt;
  const std::string last = fmt::format("'{}'?", with.back());
  with.pop_back();
  if (with.empty()) return "did you mean " + last;
  return fmt::format("did you mean '{}' or {}", fmt::join(with, "', '"), last);
}

std::string suggestion(std::string_view misspelt, const std::vector<std::string>& names) {
  const std::optional<std::string> near = near_suggestion(misspelt, names);
  return near ? *near : fmt::format("must be one of {}", fmt::join(names, ", "));
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/column_key.h"

#include <algorithm>
#include <utility>

#include "sim/core/text/words.h"

namespace seaglint {
namespace {

// Longer spellings of units, and the usual one.
constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
    {"degree", "deg"}, {"degrees", "deg"}, {"radian", "rad"}, {"radians", "rad"}, {"sec", "s"},    {"second", "s"},
    {"seconds", "s"},  {"meter", "m"},     {"meters", "m"},   {"metre", "m"},     {"metres", "m"}, {"hertz", "hz"}};

constexpr std::string_view kUsualUnits[] = {"s",        "ms",    "min",  "h",    "deg", "rad",  "m",     "mm",
                                            "cm",       "km",    "ft",   "in",   "hz",  "ghz",  "mhz",   "rad_s",
                                            "m_s",      "deg_s", "m_s2", "m2",   "m3",  "m2_s", "m2_hz", "m2_s_rad",
                                            "m2_rad_s", "n",     "kn",   "dbsm", "db",  "grad", "1"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

// Lower case; everything that is no letter or digit becomes one underscore between them.
std::string spelt(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
      {"\xc2\xb2", "2"}, {"\xc2\xb3", "3"}, {"\xc2\xb0", "_deg"}, {"\xcf\x89", "omega"}, {"**", ""}, {"^", ""}};
  std::string key;
  while (!text.empty()) {
    const auto sign = std::find_if(std::begin(kSigns), std::end(kSigns),
                                   [&](const auto& known) { return text.starts_with(known.first); });
    if (sign != std::end(kSigns)) {
      const bool doubled = sign->second.starts_with('_') && (key.empty() || key.back() == '_');
      key += sign->second.substr(doubled ? 1 : 0);
      text.remove_prefix(sign->first.size());
      continue;
    }
    const char c =
        text.front() >= 'A' && text.front() <= 'Z' ? static_cast<char>(text.front() - 'A' + 'a') : text.front();
    if (is_letter(c)) {
      key += c;
    } else if (!key.empty() && key.back() != '_') {
      key += '_';
    }
    text.remove_prefix(1);
  }
  while (key.ends_with('_')) key.pop_back();
  const std::size_t last = key.rfind('_') + 1;  // 0 without an underscore
  for (const auto& [longer, usual] : kUnits) {
    if (std::string_view(key).substr(last) == longer) return key.replace(last, std::string::npos, usual);
  }
  return key;
}

}  // namespace

std::string column_key(std::string_view name, std::string_view unit) {
  std::string key = spelt(name);
  const std::string of_unit = spelt(unit);
  if (of_unit.empty() || key == of_unit || key.ends_with("_" + of_unit)) return key;
  return key + "_" + of_unit;
}

std::string_view bracketed_unit(std::string_view name) {
  if (!name.ends_with(']') && !name.ends_with(')')) return {};
  const std::size_t open = name.rfind(name.back() == ']' ? '[' : '(');
  return open == std::string_view::npos ? std::string_view() : name.substr(open);
}

bool is_unit(std::string_view cell) {
  if (cell.empty() || cell == "-" || !bracketed_unit(cell).empty()) return true;
  const std::string unit = spelt(cell);
  return std::find(std::begin(kUsualUnits), std::end(kUsualUnits), unit) != std::end(kUsualUnits);
}

}  // namespace seaglint

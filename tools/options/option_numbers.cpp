// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/option_numbers.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

#include "sim/core/text/number.h"

namespace seaglint {
namespace {

std::string shown(const std::string& text) { return text.empty() ? "''" : text; }

template <class Whole>
std::string rewrite_whole(std::string& text, const std::optional<Whole>& value, const char* bound) {
  if (!value) return fmt::format("value {}: must be a whole number{}", shown(text), bound);
  text = fmt::format("{}", *value);
  return "";
}

}  // namespace

std::string number_error(const std::string& text) {
  return parse_number(text) ? "" : fmt::format("value {}: must be a number", shown(text));
}

std::string number_error(const std::string& text, double lowest, double highest) {
  const std::optional<double> value = parse_number(text);
  const bool inside = value && *value >= lowest && *value <= highest;
  return inside ? "" : fmt::format("value {}: must be within {} and {}", shown(text), lowest, highest);
}

std::string rewrite_integer(std::string& text) { return rewrite_whole(text, parse_integer(text), ""); }
std::string rewrite_natural_number(std::string& text) {
  return rewrite_whole(text, parse_natural(text), ", 0 or more");
}

}  // namespace seaglint

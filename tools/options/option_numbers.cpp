// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/option_numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

#include "sim/core/text/number.h"

namespace seaglint {
namespace {

std::string shown(const std::string& text) { return text.empty() ? "''" : text; }

// The text as a decimal integer, or nothing if any part of it is not.
template <class Whole>
std::optional<Whole> parse_whole(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Whole value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

template <class Whole>
std::string rewrite_whole(std::string& text, const char* bound) {
  const std::optional<Whole> value = parse_whole<Whole>(text);
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

std::string rewrite_integer(std::string& text) { return rewrite_whole<std::int64_t>(text, ""); }
std::string rewrite_natural_number(std::string& text) { return rewrite_whole<std::uint64_t>(text, ", 0 or more"); }

}  // namespace seaglint

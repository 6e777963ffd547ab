// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/option_numbers.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <optional>
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

// Rewrites the number in digits that CLI11 parses to the same value.
template <class Whole>
CLI::Validator decimal_whole(const char* bound) {
  const auto rewrite = [bound](std::string& text) {
    const std::optional<Whole> value = parse_whole<Whole>(text);
    if (!value) return fmt::format("value {}: must be a whole number{}", shown(text), bound);
    text = fmt::format("{}", *value);
    return std::string();
  };
  return CLI::Validator(rewrite, "");
}

CLI::Validator decimal_number() {
  const auto check = [](const std::string& text) {
    return parse_number(text) ? std::string() : fmt::format("value {}: must be a number", shown(text));
  };
  return CLI::Validator(check, "");
}

}  // namespace

CLI::Validator number_within(double lowest, double highest) {
  const auto check = [lowest, highest](const std::string& text) {
    const std::optional<double> value = parse_number(text);
    const bool inside = value && *value >= lowest && *value <= highest;
    return inside ? std::string() : fmt::format("value {}: must be within {} and {}", shown(text), lowest, highest);
  };
  return CLI::Validator(check, fmt::format("within {} and {}", lowest, highest));
}

void require_decimal_numbers(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("INT")) option->transform(decimal_whole<std::int64_t>(""));
    if (type.starts_with("UINT")) option->transform(decimal_whole<std::uint64_t>(", 0 or more"));
    if (type.starts_with("FLOAT"))
      option->check(decimal_number());  // after an option's own bounds, whose message is more specific
  }
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) require_decimal_numbers(*command);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/core/process/error.h"

namespace seaglint {

std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<double> parse_range(std::string_view text, std::size_t max_count) {
  const auto fail = [&](const std::string& bound) {
    throw InputError(fmt::format("value '{}': must be {}", text, bound));
  };
  std::vector<double> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    const std::optional<double> part = parse_number(text.substr(begin, end - begin));
    if (!part) fail("a number or from:to:step");
    parts.push_back(*part);
    begin = end + 1;
  }
  if (parts.size() == 1) return parts;
  if (parts.size() != 3) fail("a number or from:to:step");

  const double from = parts[0];
  const double to = parts[1];
  const double step = parts[2];
  if (step == 0) fail("from:to:step with a step other than 0");
  const double steps = (to - from) / step;
  if (steps < 0) fail("from:to:step with a step that leads from the first value to the second");
  if (!(steps < static_cast<double>(max_count))) fail(fmt::format("a range of at most {} values", max_count));

  constexpr double kOfAStep = 1e-9;
  const auto last = static_cast<std::size_t>(steps + kOfAStep);
  std::vector<double> values(last + 1);
  for (std::size_t i = 0; i <= last; ++i) values[i] = from + static_cast<double>(i) * step;
  if (std::abs(steps - static_cast<double>(last)) <= kOfAStep) values.back() = to;
  return values;
}

}  // namespace seaglint

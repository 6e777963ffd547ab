// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Parsing of numbers and ranges in scenario files and on the command line.

#include <optional>
#include <string_view>
#include <vector>

namespace seaglint {

// The whole text as a finite decimal number ("16", "-0.5", "+2.5e3"), else nullopt, also for hexadecimal, infinity and
// NaN.
std::optional<double> parse_number(std::string_view text);

// "A" is one value; "from:to:step" are from, from + step, ... up to `to`, which is included when it lies within 1e-9 of
// a step of that grid (and is then exactly `to`). The step may be negative. Throws InputError "value '...': must be
// ...", also for more than max_count values.
std::vector<double> parse_range(std::string_view text, std::size_t max_count = 1000000);

}  // namespace seaglint

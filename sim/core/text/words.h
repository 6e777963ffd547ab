// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Lines, words and numbers of untrusted text, independent of the locale. The one reader of numbers and ranges: files,
// scenarios, command line.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

// Removes a UTF-8 byte order mark from the front; true where there was one.
bool remove_byte_order_mark(std::string& bytes);

// A text without a byte order mark, with line ends \r alone made \n.
std::string plain_lines(std::string bytes);

// The next word separated by spaces, tabs or line ends, removed from the front of `text`; empty at the end.
std::string_view next_word(std::string_view& text);

// All words of a text.
std::vector<std::string_view> words_of(std::string_view text);

// The next line without its line end (\n or \r\n), removed from the front of `text`.
std::string_view next_line(std::string_view& text);

// The text without spaces, tabs and \r at its ends.
std::string_view trimmed(std::string_view text);

// The text with A to Z in lower case, the same without and with a locale.
std::string lower_case(std::string_view text);

// A finite decimal number ("16", "-0.5", "+2.5e3"); nullopt also for hexadecimal, infinity and NaN.
std::optional<double> parse_number(std::string_view text);

// The same, or infinity or NaN ("inf", "-Infinity", "nan"): for formats that define them.
std::optional<double> parse_any_number(std::string_view text);

// The same as other systems and Fortran write it: one comma for the decimal point, D for the exponent's E.
std::optional<double> parse_written_number(std::string_view text);

// A decimal integer within the limits of its type ("-3", "+12").
std::optional<std::int64_t> parse_integer(std::string_view text);
std::optional<std::uint64_t> parse_natural(std::string_view text);

// Decimals of a number that are not trailing zeros: 2 of "0.0300" and of "3e-2", 0 of "120"; nullopt for more digits
// than a double holds. A comma counts as the decimal point.
std::optional<int> significant_decimals(std::string_view text);

// "A" is one value; "from:to:step" are from, from + step, ... up to `to`, which is included when it lies within 1e-9 of
// a step of that grid (and is then exactly `to`). Values are those of the decimal sums: 0:1:0.1 has 0.3, not
// 0.30000000000000004. The step may be negative. Throws InputError "value '...': must be ...", also for more than
// max_count values.
std::vector<double> parse_range(std::string_view text, std::size_t max_count = 1000000);

}  // namespace seaglint

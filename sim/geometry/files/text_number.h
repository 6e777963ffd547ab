// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Words and numbers of untrusted text, without locale, and positions as OpenMesh can hold them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace seaglint {

// The next word separated by spaces, tabs or line ends, removed from the front of `text`; empty at the end.
std::string_view next_word(std::string_view& text);

// The next line without its line end (\n or \r\n), removed from the front of `text`.
std::string_view next_line(std::string_view& text);

// A name as UTF-8, which glTF needs: text that is none already is taken as Latin-1.
std::string utf8_of(std::string_view name);

std::optional<double> number_of(std::string_view word);
std::optional<std::int64_t> integer_of(std::string_view word);

// A coordinate as float32. Not finite and beyond 1e30 is nothing; below 1e-30 is zero, which keeps float text
// conversions exact.
std::optional<float> coordinate_of(double value);

}  // namespace seaglint

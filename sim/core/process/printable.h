// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Text that may contain any bytes of a user's file, made safe for terminals and logs.

#include <cstddef>
#include <string>
#include <string_view>

namespace seaglint {

// Escapes as \xHH what a terminal could take for a command or show as other text: control characters but line breaks
// and tabs, also those of Latin-1 (U+0080 to U+009F), line separators and characters that change the direction of
// writing (U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069), the byte order mark, and bytes that are no UTF-8 (RFC
// 3629).
std::string printable(std::string_view text);

// The same on one line: line breaks as \n and tabs escaped too. At most `longest` characters, then "...".
std::string on_one_line(std::string_view text, std::size_t longest = std::string_view::npos);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Text that may contain any bytes of a user's file, made safe for terminals and logs.

#include <string>
#include <string_view>

namespace seaglint {

// Escapes as \xHH what a terminal could take for a command or show as other text: control characters but line breaks
// and tabs, also those of Latin-1 (U+0080 to U+009F), characters that change the direction of writing (U+200E to
// U+200F, U+202A to U+202E, U+2066 to U+2069), and bytes that are no UTF-8 (RFC 3629).
std::string printable(std::string_view text);

// The same on one line, with line breaks and tabs escaped too.
std::string on_one_line(std::string_view text);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seaglint {

// Length of the character at the front of a text, bytes; 0 for an empty text and where none begins in UTF-8 (RFC 3629).
std::size_t utf8_character(std::string_view text);

// Length of the valid UTF-8 prefix (RFC 3629), bytes.
std::size_t utf8_prefix(std::string_view text);

// The text as UTF-8; text that is not valid UTF-8 is read as Latin-1.
std::string utf8_of(std::string_view text);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Locale-independent lines and words of untrusted text.

#include <string>
#include <string_view>

namespace seaglint {

// Removes a UTF-8 byte order mark from the front; true where there was one.
bool remove_byte_order_mark(std::string& bytes);

// A text without a byte order mark, with line ends \r alone made \n.
std::string plain_lines(std::string bytes);

// The next word separated by spaces, tabs or line ends, removed from the front of `text`; empty at the end.
std::string_view next_word(std::string_view& text);

// The next line without its line end (\n or \r\n), removed from the front of `text`.
std::string_view next_line(std::string_view& text);

// The text without spaces, tabs and \r at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Parts of untrusted texts as error messages show them.

#include <cstddef>
#include <string>
#include <string_view>

namespace seaglint {

inline constexpr std::size_t kLongestShown = 120;  // characters

// At most `longest` characters, then "..."; control characters, marks of the writing direction and bytes that are no
// UTF-8 as \x1b, line ends as \n. Terminals obey none of the result.
std::string shown(std::string_view text, std::size_t longest = kLongestShown);

// The same of any length: a message or a name on one line.
std::string shown_whole(std::string_view text);

// shown() in single quotes.
std::string in_quotes(std::string_view text);

}  // namespace seaglint

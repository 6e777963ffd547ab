// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Parts of untrusted texts as error messages show them.

#include <cstddef>
#include <string>
#include <string_view>

namespace seaglint {

inline constexpr std::size_t kLongestShown = 120;  // characters

// on_one_line() of at most `longest` characters.
std::string shown(std::string_view text, std::size_t longest = kLongestShown);

// shown() in single quotes.
std::string in_quotes(std::string_view text);

// The first character that looks like a blank, a sign or a quote of ASCII and is none: "U+00A0, a no-break space";
// empty without one.
std::string lookalike_in(std::string_view text);

// "; it has U+00A0, a no-break space" for a text that has one, else nothing.
std::string lookalike_note(std::string_view text);

}  // namespace seaglint

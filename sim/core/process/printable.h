// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Text that may contain any bytes of a user's file: read as UTF-8, made safe for terminals and logs, printed, shown in
// error messages, and written into tables and documents, where it must not be taken for structure or a command.

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace seaglint {

// Length of the character at the front of a text, bytes; 0 for an empty text and where none begins in UTF-8 (RFC 3629).
std::size_t utf8_character(std::string_view text);

// Length of the valid UTF-8 prefix (RFC 3629), bytes.
std::size_t utf8_prefix(std::string_view text);

// The text as UTF-8; text that is not valid UTF-8 is read as Latin-1.
std::string utf8_of(std::string_view text);

// Escapes as \xHH what a terminal could take for a command or show as other text: control characters but line breaks
// and tabs, also those of Latin-1 (U+0080 to U+009F), line separators and characters that change the direction of
// writing (U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069), the byte order mark, and bytes that are no UTF-8 (RFC
// 3629).
std::string printable(std::string_view text);

// The same on one line: line breaks as \n and tabs escaped too. At most `longest` characters, then "...".
std::string on_one_line(std::string_view text, std::size_t longest = std::string_view::npos);

// Prints the text on standard output as printable() returns it. Failures are found when standard output is flushed at
// the end.
void print_text(std::string_view text);

// The same for the values in a format.
template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}

// Prints the text on standard error as printable() returns it; does nothing when it is closed or full.
void print_error(const std::string& text);

// Opens /dev/null on those of the standard streams 0 to 2 that are closed at program start, whose numbers the next
// opened file would otherwise take. Writing to a closed standard output still fails afterwards; text for a closed
// standard error is discarded.
void reserve_standard_streams();

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

// First difference of two texts, for users: "line 12: `seed: 43` there, `seed: 42` here".
std::string first_difference(const std::string& there, const std::string& here);

// A cell of a CSV table (RFC 4180): quoted where it contains a comma, a quote or outer blanks. Text that a spreadsheet
// would take for a formula (=, +, -, @ at its beginning) gets an apostrophe in front; control characters are escaped.
std::string csv_cell(std::string_view text);

// Markdown that shows the text on one line, in a paragraph or a table's cell: no HTML, link, code or cell of its own.
std::string markdown_text(std::string_view text);

// The text as inline code of Markdown; not for a table's cell.
std::string markdown_code(std::string_view text);

}  // namespace seaglint

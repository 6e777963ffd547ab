// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The text of a file, and the positions of its parts in error messages.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace seaglint {

// A text in UTF-8 with line ends \n or \r\n. Of what other programs write, a byte order mark is removed, a text in
// Latin-1 is converted, line ends \r alone become \n, a Ctrl-Z at the end is removed, a minus sign (U+2212) becomes -
// and a no-break, figure or thin space a blank. Copies share the text.
class TextSource {
 public:
  // Throws InputError for UTF-16, UTF-32 and binary files, naming what they are.
  TextSource(std::string name, std::string bytes);
  static TextSource read(const std::filesystem::path& file, std::size_t max_bytes = std::size_t{1} << 30);

  const std::string& name() const { return name_; }
  std::string_view text() const { return *text_; }

  // Position of a part of text(): its line from 1; "NAME:LINE:COLUMN", with the column in characters from 1.
  int line_of(std::string_view part) const;
  std::string place(std::string_view part) const;
  // Throws InputError "NAME:LINE:COLUMN: what".
  [[noreturn]] void fail(std::string_view part, const std::string& what) const;

 private:
  std::string name_;
  std::shared_ptr<const std::string> text_;
};

// What a file is by its first bytes, with what to do, if it is no text of one byte per character: "a text in UTF-16:
// save it as UTF-8"; else empty.
std::string_view foreign_kind(std::string_view bytes);

// A line of a note: its first character other than blanks is # or %, or it begins with // or !.
bool is_comment(std::string_view line);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sections of Gmsh's .msh files and the values in them, as words of a text or in binary.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim/core/text/text_source.h"

namespace seaglint {

class GmshValues {
 public:
  // Reads $MeshFormat. Throws InputError for versions other than 2.0 to 2.2 and 4.1, and other sizes than doubles.
  GmshValues(std::string bytes, std::string file);
  GmshValues(const GmshValues&) = delete;
  GmshValues& operator=(const GmshValues&) = delete;

  int version() const { return version_; }  // 2 or 4

  // Moves into the next section; false at the end of the file.
  bool next_section();
  std::string_view section() const { return section_; }
  // Moves behind $End... of the section; throws InputError where it does not follow, or nowhere.
  void end_section();
  void skip_section();

  // The next value. Throws InputError at the end of the file and for anything else than a number.
  std::int64_t small();  // int32 in binary
  std::int64_t large();  // int64 in binary
  double real();
  // A count or number that is written as text in binary files of version 2, too.
  std::int64_t word();
  // The rest of the line, as text in binary files too.
  std::string_view line();

  const char* at() const { return at_; }  // of the value that was read last
  std::string place(const char* at) const;
  [[noreturn]] void fail(const std::string& what) const;  // there
  bool is_binary() const { return is_binary_; }

 private:
  void read_format();
  std::string_view take_word();
  std::int64_t integer_of(std::string_view word) const;
  const char* take(std::size_t size);
  [[noreturn]] void fail_end() const;

  std::string file_;
  std::string bytes_;                 // of a binary file
  std::optional<TextSource> source_;  // of a text
  std::string_view rest_, section_;
  const char* at_ = nullptr;
  int version_ = 0;
  bool is_binary_ = false, swap_ = false;
};

}  // namespace seaglint

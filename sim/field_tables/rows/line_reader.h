// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Goes through a text line by line; every error names the place.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "sim/core/text/text_source.h"

namespace seaglint {

class LineReader {
 public:
  explicit LineReader(const TextSource& source) : source_(source), rest_(source.text()) {}

  // Goes to the next line that is not empty; false at the end.
  bool advance();
  // The same; throws InputError "ends before WANTED" at the end.
  std::string_view next(std::string_view wanted);
  // Goes to the next line that begins so.
  void seek(std::string_view beginning);

  std::string_view line() const { return line_; }  // without blanks at its ends
  int number() const { return number_; }           // of the line, from 1

  // The finite numbers of the present line, which has exactly N of them, separated by blanks.
  template <std::size_t N>
  std::array<double, N> numbers(std::string_view what) const {
    std::array<double, N> values{};
    parse(what, values.data(), N);
    return values;
  }
  // A number of the present line as a count from 1 to 1e8.
  std::size_t count(std::string_view what, double value) const;
  // Throws InputError at the present line.
  [[noreturn]] void fail(const std::string& what) const { source_.fail(line_, what); }

 private:
  void parse(std::string_view what, double* values, std::size_t count) const;

  const TextSource& source_;
  std::string_view rest_, line_;
  int number_ = 0;
};

}  // namespace seaglint

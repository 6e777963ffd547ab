// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Datasets of I-DEAS universal files: a line with -1, one with the number, the records, a line with -1.

#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/core/text/text_source.h"

namespace seaglint {

class UnvDatasets {
 public:
  explicit UnvDatasets(TextSource source) : source_(std::move(source)), rest_(source_.text()) {}

  // Moves to the next dataset; false at the end of the file. Throws InputError for text between datasets and a dataset
  // that is cut off.
  bool next();

  int number() const { return number_; }
  bool is_done() const { return body_.empty(); }  // no record is left
  std::string_view line();                        // the next record
  const char* at() const { return line_.data(); }

  // The next record of at least `count` integers: the first `count`, at most eight.
  std::vector<std::int64_t> integers(std::size_t count, const char* what);
  // The next `count` integers of any number of records.
  std::vector<std::int64_t> wrapped_integers(std::size_t count, const char* what);
  // The next record of at least `count` numbers: the first `count`.
  std::vector<double> numbers(std::size_t count, const char* what);

  [[noreturn]] void fail(const std::string& what) const;  // at the record that was read last
  const TextSource& source() const { return source_; }

 private:
  std::int64_t integer(std::string_view word, const char* what) const;
  double number(std::string_view word, const char* what) const;

  TextSource source_;
  std::string_view rest_, body_, line_;
  int number_ = 0;
};

}  // namespace seaglint

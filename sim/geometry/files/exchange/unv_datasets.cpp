// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/exchange/unv_datasets.h"

#include <fmt/format.h>

#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/words.h"

namespace seaglint {
namespace {

bool is_mark(std::string_view line) { return trimmed(line) == "-1"; }

// "2411", or "58b" with further fields for binary records.
std::optional<std::int64_t> dataset_number(std::string_view line) {
  std::string_view word = next_word(line);
  if (word.ends_with('b')) word.remove_suffix(1);
  return parse_integer(word);
}

}  // namespace

void UnvDatasets::fail(const std::string& what) const {
  source_.fail(trimmed(line_), fmt::format("dataset {}: {}", number_, what));
}

bool UnvDatasets::next() {
  std::string_view line;
  do {
    if (rest_.empty()) return false;
    line = next_line(rest_);
  } while (trimmed(line).empty());
  if (!is_mark(line))
    source_.fail(trimmed(line), fmt::format("{} where -1 begins a dataset", in_quotes(trimmed(line))));
  line_ = rest_.empty() ? line : next_line(rest_);
  const std::optional<std::int64_t> number = dataset_number(line_);
  if (!number || *number <= 0 || *number > 1000000)
    source_.fail(trimmed(line_), fmt::format("{} where the number of a dataset belongs", in_quotes(trimmed(line_))));
  number_ = static_cast<int>(*number);
  body_ = rest_;
  while (!rest_.empty()) {
    const char* begin = rest_.data();
    if (!is_mark(next_line(rest_))) continue;
    body_ = body_.substr(0, static_cast<std::size_t>(begin - body_.data()));
    return true;
  }
  fail("ends without -1: the file is cut off");
}

std::string_view UnvDatasets::line() {
  if (body_.empty()) fail("ends within a record");
  return line_ = next_line(body_);
}

std::int64_t UnvDatasets::integer(std::string_view word, const char* what) const {
  const std::optional<std::int64_t> value = parse_integer(word);
  if (!value) source_.fail(word, fmt::format("{}: value {}: must be an integer", what, in_quotes(word)));
  return *value;
}

double UnvDatasets::number(std::string_view word, const char* what) const {
  const std::optional<double> value =
      word.find(',') == std::string_view::npos ? parse_written_number(word) : std::nullopt;
  if (!value || !std::isfinite(*value))
    source_.fail(word, fmt::format("{}: value {}: must be a number", what, in_quotes(word)));
  return *value;
}

std::vector<std::int64_t> UnvDatasets::integers(std::size_t count, const char* what) {
  std::string_view text = line();
  std::vector<std::int64_t> values;
  while (values.size() < count) {
    const std::string_view word = next_word(text);
    if (word.empty()) fail(fmt::format("{}: {} fields: must be {}", what, values.size(), count));
    values.push_back(integer(word, what));
  }
  return values;
}

std::vector<std::int64_t> UnvDatasets::wrapped_integers(std::size_t count, const char* what) {
  std::vector<std::int64_t> values;
  while (values.size() < count) {
    std::string_view text = line();
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
      if (values.size() == count) fail(fmt::format("{}: more than {} fields", what, count));
      values.push_back(integer(word, what));
    }
  }
  return values;
}

std::vector<double> UnvDatasets::numbers(std::size_t count, const char* what) {
  std::string_view text = line();
  std::vector<double> values;
  while (values.size() < count) {
    const std::string_view word = next_word(text);
    if (word.empty()) fail(fmt::format("{}: {} fields: must be {}", what, values.size(), count));
    values.push_back(number(word, what));
  }
  return values;
}

}  // namespace seaglint

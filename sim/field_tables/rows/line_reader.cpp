// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/rows/line_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/words.h"

namespace seaglint {

bool LineReader::advance() {
  while (!rest_.empty()) {
    const std::string_view line = trimmed(next_line(rest_));
    ++number_;
    if (line.empty()) continue;
    line_ = line;
    return true;
  }
  return false;
}

std::string_view LineReader::next(std::string_view wanted) {
  if (!advance()) throw InputError(fmt::format("{}:{}: ends before {}", source_.name(), number_, wanted));
  return line_;
}

void LineReader::seek(std::string_view beginning) {
  const std::string wanted = fmt::format("a line '{}'", beginning);
  while (!next(wanted).starts_with(beginning)) {
  }
}

std::size_t LineReader::count(std::string_view what, double value) const {
  if (value < 1 || value > 1e8 || value != std::floor(value))
    fail(fmt::format("{}: must be a whole number from 1 to 1e8", what));
  return static_cast<std::size_t>(value);
}

void LineReader::parse(std::string_view what, double* values, std::size_t count) const {
  std::string_view words = line_;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view word = next_word(words);
    const std::optional<double> value = parse_written_number(word);
    if (!value || !std::isfinite(*value)) {
      source_.fail(word.empty() ? line_ : word,
                   fmt::format("{}: must be {} finite number{}", what, count, count == 1 ? "" : "s"));
    }
    values[i] = *value;
  }
  if (!trimmed(words).empty())
    source_.fail(trimmed(words), fmt::format("{}: must be {} number{}", what, count, count == 1 ? "" : "s"));
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

// A number of the file with its place in the text.
struct Code {
  std::string_view word;
  std::int64_t value = 0;
};

// The whole number of a word, in any notation: "3", "3.", "3.000e+00", "3.0D+00".
std::optional<std::int64_t> whole_number(std::string_view word) {
  if (const std::optional<std::int64_t> integer = parse_integer(word)) return integer;
  constexpr double kLargest = 1e9;  // far above any number of carriers
  const std::optional<double> value = parse_written_number(word);
  if (!value || !(std::abs(*value) <= kLargest) || *value != std::round(*value)) return std::nullopt;
  return static_cast<std::int64_t>(*value);
}

// MATLAB's line above the columns of a long row: "Columns 1 through 13", "Column 14".
bool is_caption(std::string_view line) {
  line = trimmed(line);
  return line.starts_with("Column ") || line.starts_with("Columns ");
}

std::vector<Code> numbers_of(const TextSource& source, const std::string& what) {
  constexpr std::string_view kSeparators = " \t\r,;\"[]";
  std::vector<Code> codes;
  for (std::string_view rest = source.text(); !rest.empty();) {
    std::string_view line = next_line(rest);
    if (is_comment(line) || is_caption(line)) continue;
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(kSeparators), line.size()));
      if (line.empty()) break;
      const std::string_view word = line.substr(0, line.find_first_of(kSeparators));
      const std::optional<std::int64_t> value = whole_number(word);
      if (!value) source.fail(word, fmt::format("{}: {}", in_quotes(word), what));
      codes.push_back({word, *value});
      line.remove_prefix(word.size());
    }
  }
  return codes;
}

}  // namespace

std::vector<int> read_hop_code(const TextSource& source, int pulses, int carriers) {
  const std::string what = fmt::format("must be a carrier's number, 0 to {} (radar.hop_count - 1)", carriers - 1);
  std::vector<int> codes;
  const std::vector<Code> numbers = numbers_of(source, what);
  for (const Code& code : numbers) {
    if (code.value >= 0 && code.value < carriers) {
      codes.push_back(static_cast<int>(code.value));
      continue;
    }
    const bool from_one =
        std::ranges::all_of(numbers, [&](const Code& any) { return any.value >= 1 && any.value <= carriers; });
    source.fail(code.word, fmt::format("{}: {}{}", in_quotes(code.word), what,
                                       from_one ? fmt::format("; the file counts from 1 to {} and has no 0: subtract 1 "
                                                              "from each number",
                                                              carriers)
                                                : ""));
  }
  if (codes.empty() || codes.size() % static_cast<std::size_t>(pulses) != 0) {
    throw InputError(fmt::format("{}: {} carrier numbers: must be radar.pulses, {}, or a multiple of them",
                                 source.name(), codes.size(), pulses));
  }
  return codes;
}

}  // namespace seaglint

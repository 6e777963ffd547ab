// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/hop_code_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

std::vector<int> codes_of(const TextSource& source, int pulses, int carriers) {
  constexpr std::string_view kSeparators = " \t\r,;\"";
  std::vector<int> codes;
  for (std::string_view rest = source.text(); !rest.empty();) {
    std::string_view line = next_line(rest);
    if (is_comment(line)) continue;
    while (true) {
      line.remove_prefix(std::min(line.find_first_not_of(kSeparators), line.size()));
      if (line.empty()) break;
      const std::string_view word = line.substr(0, line.find_first_of(kSeparators));
      const std::optional<std::int64_t> code = parse_integer(word);
      if (!code || *code < 0 || *code >= carriers) {
        source.fail(word, fmt::format("{}: must be a carrier's number, 0 to {} (radar.hop_count - 1)", in_quotes(word),
                                      carriers - 1));
      }
      codes.push_back(static_cast<int>(*code));
      line.remove_prefix(word.size());
    }
  }
  if (codes.empty() || codes.size() % static_cast<std::size_t>(pulses) != 0) {
    throw InputError(fmt::format("{}: {} carrier numbers: must be radar.pulses, {}, or a multiple of them",
                                 source.name(), codes.size(), pulses));
  }
  return codes;
}

}  // namespace

std::vector<int> parse_hop_code(const std::string& text, const std::string& file_name, int pulses, int carriers) {
  return codes_of(TextSource(file_name, text), pulses, carriers);
}

std::vector<int> read_hop_code(const std::filesystem::path& file, int pulses, int carriers) {
  return codes_of(TextSource::read(file, std::size_t{64} << 20), pulses, carriers);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/hop_code_file.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

std::vector<int> parse_hop_code(const std::string& text, const std::string& file_name, int pulses, int carriers) {
  std::vector<int> codes;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.starts_with('#')) continue;
    for (char& c : line) {
      if (c == ',' || c == '\t' || c == '\r') c = ' ';
    }
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      int code = -1;
      const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), code);
      if (error != std::errc() || rest != word.data() + word.size() || code < 0 || code >= carriers) {
        throw InputError(fmt::format("{}:{}: '{}': must be a carrier's number, 0 to {} (radar.hop_count - 1)",
                                     file_name, number, word, carriers - 1));
      }
      codes.push_back(code);
    }
  }
  if (codes.empty() || codes.size() % static_cast<std::size_t>(pulses) != 0) {
    throw InputError(fmt::format("{}: {} carrier numbers: must be radar.pulses, {}, or a multiple of them", file_name,
                                 codes.size(), pulses));
  }
  return codes;
}

std::vector<int> read_hop_code(const std::filesystem::path& file, int pulses, int carriers) {
  return parse_hop_code(read_file(file, std::size_t{64} << 20), file.string(), pulses, carriers);
}

}  // namespace seaglint

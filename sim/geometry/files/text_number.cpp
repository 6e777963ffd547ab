// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/text_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/core/text/utf8.h"

namespace seaglint {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

template <typename Number>
std::optional<Number> whole_word(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || word.empty()) return std::nullopt;
  return value;
}

}  // namespace

std::string utf8_of(std::string_view name) {
  if (utf8_prefix(name) == name.size()) return std::string(name);
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xC0 | (byte >> 6));
      text += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return text;
}

std::string_view next_word(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::optional<double> number_of(std::string_view word) { return whole_word<double>(word); }
std::optional<std::int64_t> integer_of(std::string_view word) { return whole_word<std::int64_t>(word); }

std::optional<float> coordinate_of(double value) {
  if (!(std::abs(value) <= 1e30)) return std::nullopt;
  return std::abs(value) < 1e-30 ? 0.0f : static_cast<float>(value) + 0.0f;
}

}  // namespace seaglint

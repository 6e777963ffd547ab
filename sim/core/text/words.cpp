// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/words.h"

#include <algorithm>

namespace seaglint {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

}  // namespace

bool remove_byte_order_mark(std::string& bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (!bytes.starts_with(kMark)) return false;
  bytes.erase(0, kMark.size());
  return true;
}

std::string plain_lines(std::string bytes) {
  remove_byte_order_mark(bytes);
  if (bytes.find('\n') == std::string::npos) std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  return bytes;
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

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  std::size_t begin = 0, end = text.size();
  while (begin < end && is_blank(text[begin])) ++begin;
  while (end > begin && is_blank(text[end - 1])) --end;
  if (begin == end) return text.substr(0, 0);
  return text.substr(begin, end - begin);
}

}  // namespace seaglint

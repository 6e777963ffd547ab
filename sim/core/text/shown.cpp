// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/shown.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/text/utf8.h"

namespace seaglint {
namespace {

// Number of bytes of the first character; 0 when the text does not begin with one in UTF-8.
std::size_t first_character(std::string_view text) {
  const auto continues = [&](std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80;
  };
  std::size_t bytes = 1;
  while (bytes < 4 && continues(bytes)) ++bytes;
  return utf8_prefix(text.substr(0, bytes)) == bytes ? bytes : 0;
}

// Controls of Unicode: C0, DEL, C1 (U+0080 to U+009F), line separators and marks of the direction of writing (U+200E,
// U+200F, U+2028 to U+202E, U+2066 to U+2069), the byte order mark.
bool is_control(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 1) return byte(0) < 0x20 || byte(0) == 0x7f;
  if (character.size() == 2) return byte(0) == 0xc2 && byte(1) < 0xa0;
  if (character.size() != 3) return false;
  if (character == "\xef\xbb\xbf") return true;
  if (byte(0) != 0xe2) return false;
  if (byte(1) == 0x80) return byte(2) == 0x8e || byte(2) == 0x8f || (byte(2) >= 0xa8 && byte(2) <= 0xae);
  return byte(1) == 0x81 && byte(2) >= 0xa6 && byte(2) <= 0xa9;
}

}  // namespace

std::string shown(std::string_view text, std::size_t longest) {
  std::string out;
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == longest) return out + "...";
    const std::size_t bytes = first_character(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(bytes, 1));
    if (bytes > 0 && !is_control(character)) {
      out += character;
    } else {
      for (const char c : character) out += c == '\n' ? "\\n" : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    text.remove_prefix(character.size());
  }
  return out;
}

std::string shown_whole(std::string_view text) { return shown(text, text.size()); }

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", shown(text)); }

}  // namespace seaglint

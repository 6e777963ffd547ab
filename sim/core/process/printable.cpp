// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sim/core/process/utf8.h"

namespace seaglint {

namespace {

// Code point of a character in UTF-8.
std::uint32_t code_of(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 1) return byte(0);
  std::uint32_t code = byte(0) & (0x7fu >> character.size());
  for (std::size_t i = 1; i < character.size(); ++i) code = code << 6 | (byte(i) & 0x3f);
  return code;
}

bool is_harmless(std::uint32_t code) {
  const auto within = [code](std::uint32_t low, std::uint32_t high) { return code >= low && code <= high; };
  return !(code < 0x20 || within(0x7f, 0x9f) || within(0x200e, 0x200f) || within(0x2028, 0x202e) ||
           within(0x2066, 0x2069) || code == 0xfeff);
}

std::string escaped(std::string_view text, std::string_view kept, std::size_t longest) {
  std::string result;
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == longest) return result + "...";
    const std::size_t bytes = utf8_character(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(bytes, 1));
    if (bytes > 0 && (is_harmless(code_of(character)) || kept.find(text[0]) != std::string_view::npos)) {
      result += character;
    } else if (text[0] == '\n') {
      result += "\\n";
    } else {
      for (const char c : character) result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    text.remove_prefix(character.size());
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) { return escaped(text, "\n\t", std::string_view::npos); }

std::string on_one_line(std::string_view text, std::size_t longest) { return escaped(text, "", longest); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/utf8.h"

namespace seaglint {

namespace {

// Length in bytes of the character with first byte `lead` (0: invalid) and the range of its second byte: RFC 3629,
// section 4, which excludes overlong forms, surrogates and values beyond U+10FFFF.
struct Character {
  std::size_t bytes = 0;
  unsigned lowest = 0x80, highest = 0xbf;
};

Character character_of(unsigned lead) {
  if (lead < 0x80) return {1};
  if (lead < 0xc2) return {};
  if (lead < 0xe0) return {2};
  if (lead < 0xf0) return {3, lead == 0xe0 ? 0xa0u : 0x80u, lead == 0xed ? 0x9fu : 0xbfu};
  if (lead < 0xf5) return {4, lead == 0xf0 ? 0x90u : 0x80u, lead == 0xf4 ? 0x8fu : 0xbfu};
  return {};
}

}  // namespace

std::size_t utf8_character(std::string_view text) {
  if (text.empty()) return 0;
  const Character character = character_of(static_cast<unsigned char>(text[0]));
  if (character.bytes > text.size()) return 0;
  for (std::size_t i = 1; i < character.bytes; ++i) {
    const unsigned byte = static_cast<unsigned char>(text[i]);
    if (byte < (i == 1 ? character.lowest : 0x80u) || byte > (i == 1 ? character.highest : 0xbfu)) return 0;
  }
  return character.bytes;
}

std::size_t utf8_prefix(std::string_view text) {
  std::size_t valid = 0;
  while (const std::size_t bytes = utf8_character(text.substr(valid))) valid += bytes;
  return valid;
}

std::string utf8_of(std::string_view text) {
  if (utf8_prefix(text) == text.size()) return std::string(text);
  std::string utf8;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      utf8 += c;
    } else {
      utf8 += static_cast<char>(0xC0 | (byte >> 6));
      utf8 += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return utf8;
}

}  // namespace seaglint

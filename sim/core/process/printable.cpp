// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/printable.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <sstream>

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

void print_text(std::string_view text) { std::fputs(printable(text).c_str(), stdout); }

void print_error(const std::string& text) {
  std::fputs(printable(text).c_str(), stderr);
  std::fflush(stderr);
}

void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // open() returns the lowest free number, which is this one.
    ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
  }
}

std::string shown(std::string_view text, std::size_t longest) { return on_one_line(text, longest); }

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", shown(text)); }

std::string lookalike_in(std::string_view text) {
  struct Lookalike {
    std::string_view bytes;
    const char* name;
  };
  constexpr Lookalike kLookalikes[] = {{"\xc2\xa0", "U+00A0, a no-break space"},
                                       {"\xc2\xad", "U+00AD, a soft hyphen"},
                                       {"\xe2\x80\x87", "U+2007, a figure space"},
                                       {"\xe2\x80\x89", "U+2009, a thin space"},
                                       {"\xe2\x80\x8a", "U+200A, a hair space"},
                                       {"\xe2\x80\x8b", "U+200B, a zero-width space"},
                                       {"\xe2\x80\x8c", "U+200C, a zero-width non-joiner"},
                                       {"\xe2\x80\x8d", "U+200D, a zero-width joiner"},
                                       {"\xe2\x80\x90", "U+2010, a hyphen"},
                                       {"\xe2\x80\x91", "U+2011, a no-break hyphen"},
                                       {"\xe2\x80\x92", "U+2012, a figure dash"},
                                       {"\xe2\x80\x93", "U+2013, an en dash"},
                                       {"\xe2\x80\x94", "U+2014, an em dash"},
                                       {"\xe2\x80\x98", "U+2018, a quotation mark"},
                                       {"\xe2\x80\x99", "U+2019, a quotation mark"},
                                       {"\xe2\x80\x9c", "U+201C, a quotation mark"},
                                       {"\xe2\x80\x9d", "U+201D, a quotation mark"},
                                       {"\xe2\x80\xaf", "U+202F, a narrow no-break space"},
                                       {"\xe2\x81\xa0", "U+2060, a word joiner"},
                                       {"\xe2\x88\x92", "U+2212, a minus sign"},
                                       {"\xe3\x80\x80", "U+3000, an ideographic space"},
                                       {"\xef\xbb\xbf", "U+FEFF, a byte order mark"},
                                       {"\xef\xbc\x8d", "U+FF0D, a full-width hyphen"},
                                       {"\xef\xbc\x9a", "U+FF1A, a full-width colon"}};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (static_cast<unsigned char>(text[i]) < 0x80) continue;
    for (const auto& [bytes, name] : kLookalikes) {
      if (text.substr(i).starts_with(bytes)) return name;
    }
  }
  return {};
}

std::string lookalike_note(std::string_view text) {
  const std::string found = lookalike_in(text);
  return found.empty() ? found : "; it has " + found;
}

std::string first_difference(const std::string& there, const std::string& here) {
  std::istringstream a(there), b(here);
  for (int line = 1;; ++line) {
    std::string left, right;
    const bool more_left = static_cast<bool>(std::getline(a, left));
    const bool more_right = static_cast<bool>(std::getline(b, right));
    if (!more_left && !more_right) return "the ends of the lines differ";
    if (left != right) return fmt::format("line {}: `{}` there, `{}` here", line, left, right);
  }
}

std::string csv_cell(std::string_view text) {
  std::string cell = on_one_line(text);
  const std::size_t first = cell.find_first_not_of(' ');
  if (first != std::string::npos && std::string_view("=+-@").find(cell[first]) != std::string_view::npos)
    cell.insert(0, 1, '\'');
  const bool outer_blanks = !cell.empty() && (cell.front() == ' ' || cell.back() == ' ');
  if (cell.find_first_of(",\";#") == std::string::npos && !outer_blanks) return cell;
  std::string quoted = "\"";
  for (const char c : cell) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string markdown_text(std::string_view text) {
  constexpr std::string_view kStructure = "\\`*[]<>|&~#";
  std::string escaped;
  for (const char c : on_one_line(text)) {
    if (kStructure.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string markdown_code(std::string_view text) {
  // A fence longer than any run of backquotes inside (CommonMark 0.31, section 6.1).
  const std::string line = on_one_line(text);
  std::size_t longest = 0, run = 0;
  for (const char c : line) longest = std::max(longest, run = c == '`' ? run + 1 : 0);
  const std::string fence(longest + 1, '`');
  const std::string_view gap = longest > 0 ? " " : "";
  return fence + std::string(gap) + line + std::string(gap) + fence;
}

}  // namespace seaglint

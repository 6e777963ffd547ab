// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/shown.h"

#include <fmt/format.h>

#include "sim/core/process/printable.h"

namespace seaglint {

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

}  // namespace seaglint

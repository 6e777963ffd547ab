// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/printable.h"

#include <gtest/gtest.h>

#include <string>

namespace seaglint {
namespace {

TEST(Printable, KeepsTextOfAnyLanguage) {
  for (const char* text : {"plain, 5 dB", "Größe 2 µm²", "корабль", "軍艦", "🚢", "two\nlines\tand tabs"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatATerminalTakesForACommand) {
  EXPECT_EQ(printable("\x1b]0;title\x07\r\x7f"), "\\x1b]0;title\\x07\\x0d\\x7f");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // control sequence introducer of Latin-1
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\xe2\\x80\\xaeb");  // right-to-left override
}

TEST(Printable, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff\xfe"
                      "a"),
            "\\xff\\xfea");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");                    // over-long
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond U+10FFFF
  EXPECT_EQ(printable("m\xe2\x82"), "m\\xe2\\x82");                  // cut off
}

TEST(Printable, IsOneLineWhereOneIsWanted) { EXPECT_EQ(on_one_line("a\nb\tc"), "a\\nb\\x09c"); }

std::string encoded(unsigned point) {
  std::string text;
  if (point < 0x80) {
    text += static_cast<char>(point);
  } else {
    const int more = point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
    constexpr unsigned kLead[] = {0, 0xc0, 0xe0, 0xf0};
    text += static_cast<char>(kLead[more] | (point >> (6 * more)));
    for (int i = more - 1; i >= 0; --i) text += static_cast<char>(0x80 | ((point >> (6 * i)) & 0x3f));
  }
  return text;
}

TEST(Utf8, ContainsEveryCodePointButSurrogates) {
  for (unsigned point = 0; point < 0x110000; ++point) {
    const std::string text = encoded(point);
    const bool surrogate = point >= 0xd800 && point < 0xe000;
    ASSERT_EQ(utf8_prefix(text), surrogate ? 0 : text.size()) << point;
  }
}

TEST(Utf8, EndsAtAnInvalidByte) {
  EXPECT_EQ(utf8_prefix("caf\xe9"), 3u);  // Latin-1
  EXPECT_EQ(utf8_prefix("caf\xc3\xa9"), 5u);
  EXPECT_EQ(utf8_prefix("a\xc3"), 1u);     // cut short
  EXPECT_EQ(utf8_prefix("\x80"), 0u);      // no lead byte
  EXPECT_EQ(utf8_prefix("\xc0\xaf"), 0u);  // overlong encoding
  EXPECT_EQ(utf8_prefix("\xe0\x80\xaf"), 0u);
  EXPECT_EQ(utf8_prefix("\xf4\x90\x80\x80"), 0u);  // beyond the last code point
  EXPECT_EQ(utf8_prefix(""), 0u);
}

TEST(Shown, KeepsPrintableTextInAnyLanguage) {
  EXPECT_EQ(shown("roll [deg]"), "roll [deg]");
  EXPECT_EQ(shown("Neigung \xc2\xb0, \xe6\xb3\xa2 \xf0\x9f\x8c\x8a"),
            "Neigung \xc2\xb0, \xe6\xb3\xa2 \xf0\x9f\x8c\x8a");
  EXPECT_EQ(in_quotes(""), "''");
}

// Escape sequences, C1 controls, marks of the writing direction and bytes that are no UTF-8.
TEST(Shown, HasNoByteThatATerminalObeys) {
  EXPECT_EQ(shown("\x1b[2J\r\n\t\x7f"), "\\x1b[2J\\x0d\\n\\x09\\x7f");
  EXPECT_EQ(shown(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(shown("\xc2\x9b"), "\\xc2\\x9b");
  EXPECT_EQ(shown("\xe2\x80\xae"), "\\xe2\\x80\\xae");
  EXPECT_EQ(shown("\xef\xbb\xbfx"), "\\xef\\xbb\\xbfx");
  EXPECT_EQ(shown("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(shown("caf\xe9"), "caf\\xe9");
  EXPECT_EQ(shown("\xe2\x82"), "\\xe2\\x82");  // cut off
  for (int byte = 0; byte < 256; ++byte) {
    for (const char c : shown(std::string(1, static_cast<char>(byte)))) {
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f) << byte;
    }
  }
}

TEST(Shown, HasAtMost120Characters) {
  EXPECT_EQ(shown(std::string(120, 'x')), std::string(120, 'x'));
  EXPECT_EQ(shown(std::string(5000, 'x')), std::string(120, 'x') + "...");
  std::string degrees, kept;
  for (int n = 0; n < 200; ++n) degrees += "\xc2\xb0";
  for (int n = 0; n < 120; ++n) kept += "\xc2\xb0";
  EXPECT_EQ(shown(degrees), kept + "...");
}

TEST(Escape, CellsOfCsvAreQuotedByRfc4180AndNoFormulas) {
  EXPECT_EQ(csv_cell("deck house 2"), "deck house 2");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_cell("=cmd|calc,\"x"), "\"'=cmd|calc,\"\"x\"");
  for (const char* formula : {"=1", "+1", "-1", "@SUM(A1)"}) EXPECT_EQ(csv_cell(formula)[0], '\'') << formula;
  EXPECT_EQ(csv_cell(" =1"), "' =1");
  EXPECT_EQ(csv_cell(" 1"), "\" 1\"");
  EXPECT_EQ(csv_cell("\t=1\nnext row"), "\\x09=1\\nnext row");
  EXPECT_EQ(csv_cell(""), "");
}

TEST(Escape, MarkdownHasNoStructureOfTheText) {
  EXPECT_EQ(markdown_text("fast-craft_1 (new).glb"), "fast-craft_1 (new).glb");
  EXPECT_EQ(markdown_text("a|b <script> [x](y) `c` &amp;"), "a\\|b \\<script\\> \\[x\\](y) \\`c\\` \\&amp;");
  EXPECT_EQ(markdown_text("a\n# b"), "a\\\\n\\# b");
}

TEST(Escape, InlineCodeOfMarkdownEndsBehindTheText) {
  EXPECT_EQ(markdown_code("quick"), "`quick`");
  EXPECT_EQ(markdown_code("a`b``c"), "``` a`b``c ```");
  EXPECT_EQ(markdown_code("a\nb"), "`a\\nb`");
}

}  // namespace
}  // namespace seaglint

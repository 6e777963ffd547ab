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

}  // namespace
}  // namespace seaglint

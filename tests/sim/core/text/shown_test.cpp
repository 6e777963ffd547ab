// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/printable.h"

#include <gtest/gtest.h>

#include <string>

namespace seaglint {
namespace {

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

}  // namespace
}  // namespace seaglint

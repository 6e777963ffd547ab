// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/printable.h"

#include <gtest/gtest.h>

#include <string>

namespace seaglint {
namespace {

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

}  // namespace
}  // namespace seaglint

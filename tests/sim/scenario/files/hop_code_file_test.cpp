// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/hop_code_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_hop_code(text, "hops.txt", 4, 8);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(HopCodeText, IsReadWithAnySeparator) {
  const char* const marked =
      "\xef\xbb\xbf"
      "0\t7\t3 \t1\r\n";
  for (const char* text : {"0 7 3 1", "0,7,3,1\n", "0;7;3;1;\r\n", "# code\n0\n7\n\n3\n1\n", marked, "0\r7\r3\r1\r"}) {
    EXPECT_EQ(parse_hop_code(text, "hops.txt", 4, 8), (std::vector<int>{0, 7, 3, 1})) << text;
  }
}

TEST(HopCodeText, IsRefusedWithThePlaceOfItsMistake) {
  EXPECT_EQ(refusal("0 7\n3 8\n"), "hops.txt:2:3: '8': must be a carrier's number, 0 to 7 (radar.hop_count - 1)");
  for (const char* word : {"-1", "1.5", "1x", "0x1", "+-1", "1e0"})
    EXPECT_THAT(refusal(std::string("0 1 2 ") + word), testing::HasSubstr("hops.txt:1:7: '" + std::string(word) + "'"));
  EXPECT_EQ(refusal("0 1 2"), "hops.txt: 3 carrier numbers: must be radar.pulses, 4, or a multiple of them");
  EXPECT_THAT(refusal(std::string("\xff\xfe"
                                  "0\0 \0",
                                  6)),
              testing::HasSubstr("UTF-16"));
}

}  // namespace
}  // namespace seaglint

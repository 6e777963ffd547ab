// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

std::string code_refusal(const std::string& text) {
  try {
    read_hop_code({"hops.txt", text}, 4, 8);
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
    EXPECT_EQ(read_hop_code({"hops.txt", text}, 4, 8), (std::vector<int>{0, 7, 3, 1})) << text;
  }
}

// numpy.savetxt, NumPy's print, MATLAB's save -ascii, writematrix, fprintf('%f') and disp, and Fortran.
TEST(HopCodeText, IsReadAsNumPyAndMatlabPrintIt) {
  for (const char* text :
       {"0.000000000000000000e+00\n7.000000000000000000e+00\n3.000000000000000000e+00\n1.000000000000000000e+00\n",
        "[0 7 3 1]\n", "[0. 7. 3. 1.]", "[[0, 7],\n [3, 1]]\n",
        "   0.0000000e+00   7.0000000e+00   3.0000000e+00   1.0000000e+00\n", "0,7,3,1\n",
        "0.000000\n7.000000\n3.000000\n1.000000\n",
        "  Columns 1 through 3\n\n     0     7     3\n\n  Column 4\n\n     1\n",
        "  Columns 1 and 2\n     0     7\n  Columns 3 and 4\n     3     1\n", " 0.0D+00 7.0D+00 3.0D+00 1.0D+00\n"}) {
    EXPECT_EQ(read_hop_code({"hops.txt", text}, 4, 8), (std::vector<int>{0, 7, 3, 1})) << text;
  }
}

TEST(HopCodeText, OfNumPysSavetxtIsThatOfPlainNumbers) {
  const std::string folder = SEAGLINT_SOURCE_DIR "/tests/cases/tables/";
  const std::vector<int> plain = read_hop_code(TextSource::read(folder + "hop_plain.txt"), 256, 8);
  EXPECT_EQ(read_hop_code(TextSource::read(folder + "hop_numpy_savetxt.txt"), 256, 8), plain);
  for (const int carrier : {0, 1, 2, 3, 4, 5, 6, 7}) EXPECT_EQ(std::count(plain.begin(), plain.end(), carrier), 32);
}

TEST(HopCodeText, ThatCountsFromOneIsNamed) {
  EXPECT_EQ(code_refusal("1 8\n4 2\n"),
            "hops.txt:1:3: '8': must be a carrier's number, 0 to 7 (radar.hop_count - 1); the file counts from 1 to 8 "
            "and has no 0: subtract 1 from each number");
  for (const char* text : {"1 8 0 2", "1 9 4 2", "-1 8 4 2"})
    EXPECT_THAT(code_refusal(text), testing::Not(testing::HasSubstr("counts from 1"))) << text;
}

TEST(HopCodeText, IsRefusedWithThePlaceOfItsMistake) {
  EXPECT_EQ(code_refusal("0 7\n3 8\n"), "hops.txt:2:3: '8': must be a carrier's number, 0 to 7 (radar.hop_count - 1)");
  for (const char* word : {"-1", "1.5", "1x", "0x1", "+-1", "1e-1", "1e400", "nan", "1:2"})
    EXPECT_THAT(code_refusal(std::string("0 1 2 ") + word),
                testing::HasSubstr("hops.txt:1:7: '" + std::string(word) + "'"));
  EXPECT_EQ(code_refusal("0 1 2"), "hops.txt: 3 carrier numbers: must be radar.pulses, 4, or a multiple of them");
  EXPECT_THAT(code_refusal(std::string("\xff\xfe"
                                       "0\0 \0",
                                       6)),
              testing::HasSubstr("UTF-16"));
}

}  // namespace
}  // namespace seaglint

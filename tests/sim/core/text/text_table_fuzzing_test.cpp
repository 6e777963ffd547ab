// SPDX-License-Identifier: BSD-3-Clause
// Deterministic fuzzing: tables with changed bytes and pieces are read, or refused with an InputError of bounded
// length.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/text/text_table.h"

namespace seaglint {
namespace {

const char* const kSeeds[] = {"# note\ntime_s,roll_deg,\"pitch_deg\"\n0,1.5,2\n0.5,-2.25,1e-3\n1,\"3\",4\n",
                              "Time;Roll;Pitch\n(s);(deg);(deg)\n0,0;1,5;2\n0,5;-2,25;3\n",
                              "A run\n\ntime [s]\troll [deg]\tpitch [deg]\r\n0\t1.5\t2\r\n0.5\t2.D0\t3\r\n",
                              "# time_s roll_deg pitch_deg\n0 1 2\n---\n1 2 3\n"};
const char* const kPieces[] = {",",        ";",    "\t",    " ",       "\"",       "\"\"",  "\n",     "\r",
                               "\r\n",     "#",    "%",     "//",      "!",        "---",   "(s)",    "[deg]",
                               "nan",      "-inf", "1e999", "1,5",     "1.5",      "0x1p3", "+-1",    "\xef\xbb\xbf",
                               "\xff\xfe", "\x00", "\x1a",  "\x1b[2J", "\xc2\xb0", "\xe9",  "time_s", "roll_deg",
                               "roll_rad"};

std::string mutated(std::uint64_t index) {
  Random random({3, Stream::kTest, index});
  std::string text = kSeeds[random.below(std::size(kSeeds))];
  for (std::uint32_t i = 0, changes = 1 + random.below(5); i < changes; ++i) {
    const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()) + 1);
    const std::size_t length = std::min<std::size_t>(random.below(20), text.size() - at);
    switch (random.below(4)) {
      case 0: text.insert(at, kPieces[random.below(std::size(kPieces))]); break;
      case 1: text.erase(at, length); break;
      case 2: text.insert(random.below(static_cast<std::uint32_t>(text.size()) + 1), text.substr(at, length)); break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(random.below(256));
    }
  }
  return text;
}

TEST(TextTableFuzzing, BrokenTablesAreReadOrRefusedWithAnInputError) {
  int read = 0, refused = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const std::string text = mutated(i);
    for (const bool named : {true, false}) {
      try {
        const TextSource source("t", text);
        const std::vector<TableColumn> columns{"time_s", "roll_deg", "pitch_deg"};
        const TextTable table = named ? TextTable(source, columns) : TextTable::without_names(source, columns);
        for (std::size_t row = 0; row < table.rows(); ++row) {
          for (std::size_t column = 0; column < 3; ++column) ASSERT_TRUE(std::isfinite(table.number(row, column)));
        }
        ++read;
      } catch (const InputError& error) {
        const std::string message = error.what();
        ASSERT_LT(message.size(), 600u) << message;
        for (const char c : message) ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << message;
        ++refused;
      }
    }
  }
  // Both outcomes occur.
  EXPECT_GT(read, 2000);
  EXPECT_GT(refused, 5000);
}

}  // namespace
}  // namespace seaglint

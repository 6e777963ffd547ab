// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

TextTable read(const std::string& text) { return TextTable(TextSource("t.csv", text), {"time_s", "roll_deg"}); }

std::string table_refusal(const std::string& text) {
  return refusal_of([&] {
    const TextTable table = read(text);
    for (std::size_t row = 0; row < table.rows(); ++row) table.number(row, 0), table.number(row, 1);
    table.check_ascending(0);
  });
}

void expect_same(const std::string& text) {
  SCOPED_TRACE(text);
  const TextTable table = read(text);
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.number(0, 0), 0);
  EXPECT_EQ(table.number(0, 1), 1.5);
  EXPECT_EQ(table.number(1, 0), 0.5);
  EXPECT_EQ(table.number(1, 1), -2.25);
}

TEST(TextTable, HasTheSeparatorOfItsNames) {
  expect_same("time_s,roll_deg\n0,1.5\n0.5,-2.25\n");
  expect_same("time_s;roll_deg\n0;1.5\n0.5;-2.25\n");
  expect_same("time_s\troll_deg\n0\t1.5\n0.5\t-2.25\n");
  expect_same("time_s   roll_deg\n  0   1.5\n0.5\t-2.25\n");
  expect_same("time_s , roll_deg\n0 , 1.5\n0.5 , -2.25");
}

TEST(TextTable, HasDecimalCommasWhereTheSeparatorAllowsThem) {
  expect_same("time_s;roll_deg\n0;1,5\n0,5;-2,25\n");
  expect_same("time_s\troll_deg\n0,0\t1,5\n0,5\t-2,25\n");
  expect_same("time_s roll_deg\n0 1,5\n0,5 -2,25\n");
  expect_same("time_s,roll_deg\n0,\"1,5\"\n\"0,5\",\"-2,25\"\n");
  EXPECT_TRUE(read("time_s;roll_deg\n0;1,5\n1;2\n").has_decimal_commas());
  EXPECT_EQ(table_refusal("time_s;roll_deg\n0;1,5\n0.5;2\n"),
            "t.csv:3:1: time_s: value '0.5': a decimal point, where line 2 has a decimal comma");
  EXPECT_THAT(table_refusal("time_s;roll_deg\n0;1.234,5\n1;2\n"), HasSubstr("t.csv:2:3: roll_deg: value '1.234,5'"));
  EXPECT_THAT(table_refusal("time_s;roll_deg\n0;1,234,567\n1;2\n"), HasSubstr("must be a finite number"));
}

TEST(TextTable, HasLinesAsOtherSystemsWriteThem) {
  expect_same("\xef\xbb\xbftime_s,roll_deg\r\n0,1.5\r\n0.5,-2.25\r\n");
  expect_same("time_s,roll_deg\r0,1.5\r0.5,-2.25\r");
  expect_same("sep=;\r\ntime_s;roll_deg;\r\n0;1,5;\r\n0,5;-2,25;\r\n;;\r\n\x1a");
  expect_same("\n# a note\ntime_s,roll_deg\n\n0,1.5\n  # another\n% and\n! and\n// more\n0.5,-2.25\n\n");
}

// RFC 4180: separators, quotes and line ends in quotes.
TEST(TextTable, HasQuotedCells) {
  expect_same("\"time_s\",\"roll_deg\"\n\"0\",\"1.5\"\n0.5,\"-2.25\"\n");
  expect_same("note,time_s,roll_deg\n\"a, \"\"b\"\"\nc\",0,1.5\n\"\",0.5,-2.25\n");
  expect_same("time_s \"note, longer\" roll_deg\n0 \"two words\" 1.5\n0.5 x -2.25\n");
  const TextTable table = read("note,time_s,roll_deg\n\"a\nb\",0,1.5\nx,0.5,-2.25\n");
  EXPECT_EQ(table.place(0), "t.csv:2");
  EXPECT_EQ(table.place(1), "t.csv:4");
  EXPECT_EQ(table_refusal("time_s,roll_deg\n0,\"1.5\n0.5,2\n"),
            "t.csv:2:3: a quote that is not closed at the end of its cell");
  EXPECT_THAT(table_refusal("time_s,roll_deg\n0,\"1.5\"x\n0.5,2\n"), HasSubstr("t.csv:2:3: a quote"));
}

TEST(TextTable, HasUnitsInNamesOrBelowThem) {
  expect_same("Time [s],Roll (degrees)\n0,1.5\n0.5,-2.25\n");
  expect_same("Time,Roll\n(s),(deg)\n0,1.5\n0.5,-2.25\n");
  expect_same("time;roll\ns;\xc2\xb0\n0;1.5\n0.5;-2.25\n");
  expect_same("time;roll\ns;\xb0\n0;1.5\n0.5;-2.25\n");  // Latin-1
  expect_same("TIME    ROLL    Wave1Elev\n(s) (deg) (m)\n0 1.5 0\n0.5 -2.25 0\n");
  EXPECT_EQ(table_refusal("time_s,roll\n0,1\n1,2\n"),
            "t.csv:1:8: roll has no unit: must be named roll_deg, or have a row of units below");
  EXPECT_EQ(table_refusal("time_s,roll [grad]\n0,1\n1,2\n"), "t.csv:1:8: unit '[grad]' of roll [grad]: must be deg");
  EXPECT_EQ(table_refusal("time,roll\n(ms),(deg)\n0,1\n1,2\n"), "t.csv:1:1: unit '(ms)' of time: must be s");
}

TEST(TextTable, HasNamesBelowTextOrInAComment) {
  expect_same("Model 12 of the yard\nmeasured in May, 2021\n\ntime_s,roll_deg\n0,1.5\n0.5,-2.25\n");
  expect_same("# time_s roll_deg\n0 1.5\n0.5 -2.25\n");
  expect_same("# time_s,roll_deg\n0,1.5\n0.5,-2.25\n");
  EXPECT_EQ(table_refusal("0,1\ntime_s,roll_deg\n0,1.5\n0.5,2\n"),
            "t.csv:1:1: numbers above the names of the columns in line 2");
}

TEST(TextTable, HasNumbersOfFortran) { expect_same("time_s roll_deg\n0.D0 1.5D+00\n5.0d-1 -2.25\n"); }

TEST(TextTable, OfKnownNamesRefusesOneThatStandsTwice) {
  const TextSource source("t.txt", "1 2 3\n");
  EXPECT_EQ(refusal_of([&] {
              TextTable::below(source, source.text(), {"theta", "phi", "theta"}, ' ');
            }),
            "t.txt: column theta appears twice: columns 1 and 3 of the table");
}

TEST(TextTable, RefusesWhatItWouldMisread) {
  EXPECT_EQ(table_refusal(""), "t.csv: 0 rows: the file is empty: must be a table with a header");
  EXPECT_EQ(table_refusal("time_s,roll_rad\n0,1\n1,2\n"),
            "t.csv:1:1: no column roll_deg; the columns are time_s, roll_rad");
  EXPECT_EQ(table_refusal("time_s,roll_deg,roll_deg\n0,1,2\n1,2,3\n"),
            "t.csv: column roll_deg appears twice: columns 2 and 3 of the table");
  EXPECT_EQ(table_refusal("time_s,roll_deg,Roll [deg]\n0,1,2\n1,2,3\n"),
            "t.csv: column roll_deg appears twice: columns 2 and 3 of the table");
  EXPECT_EQ(table_refusal("time_s,roll_deg\n0,1\n1\n"), "t.csv:3:1: 1 cells where the names are 2, separated by ','");
  EXPECT_EQ(table_refusal("time_s,roll_deg\n0,1\n1,2,3\n"),
            "t.csv:3:1: 3 cells where the names are 2, separated by ','");
  EXPECT_EQ(table_refusal("time_s,roll_deg\n0,1\n"), "t.csv: 1 rows of numbers below the names: must be at least 2");
  EXPECT_EQ(table_refusal("time_s,roll_deg\n0,1\n0,2\n"),
            "t.csv:3:1: time_s: value '0': must be greater than 0 of line 2");
  for (const char* cell :
       {"nan", "inf", "-Inf", "1/xyz", "0x1p3zzz", "0x10", "+-1", "1 2", "", "********", "1e", "1e999"}) {
    EXPECT_THAT(table_refusal(std::string("time_s,roll_deg\n0,1\n1,") + cell + "\n2,2\n"),
                HasSubstr(std::string("t.csv:3:3: roll_deg: value '") + cell + "': must be a finite number"));
  }
  EXPECT_EQ(table_refusal("time_s,roll_deg\n0,1\n1,\x1b[2J" + std::string(500, 'x') + "\n").find('\x1b'),
            std::string::npos);
  EXPECT_LT(table_refusal("time_s,roll_deg\n0,1\n1," + std::string(5000, 'x') + "\n").size(), 220u);
  EXPECT_LT(table_refusal(std::string(5000, 'x') + "\n0,1\n1,2\n").size(), 220u);
}

TEST(TextTable, WithoutNamesHasItsColumnsByTheirPlace) {
  for (const char* text : {"1 2,5 -inf\n2 3 4,5\n", "1,2.5,-inf\n2,3,4.5\n", "1;2,5;-inf\n2;3;4,5\n",
                           "\xef\xbb\xbf  1\t2.5 -inf\r\n\r\n2 3 4.5\r\n", "PER BETA MOD\n1 2.5 -inf\n2 3 4.5\n",
                           "A title\n# note\n\"a\";\"b\";\"c\"\n1;2.5;-inf;\n2;3;4.5;\n"}) {
    SCOPED_TRACE(text);
    const TextTable table = TextTable::without_names(TextSource("t", text), {"a", "b", "c"});
    ASSERT_EQ(table.rows(), 2u);
    EXPECT_EQ(table.number(0, 1), 2.5);
    EXPECT_EQ(table.level(0, 2), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(table.number(1, 2), 4.5);
  }
  EXPECT_EQ(refusal_of([] {
              TextTable::without_names(TextSource("t", "1 2\n"), {"a", "b", "c"});
            }),
            "t:1:1: 2 cells where the names are 3, separated by blanks");
  EXPECT_EQ(refusal_of([] {
              TextTable::without_names(TextSource("t", "1 2 3\n1 2 3 4\n"), {"a", "b", "c"});
            }),
            "t:2:1: 4 cells where the names are 3, separated by blanks");
  EXPECT_EQ(refusal_of([] {
              TextTable::without_names(TextSource("t", "1 2 3\n1 -2 3\n"), {"a", "b", "c"}).positive(1, 1);
            }),
            "t:2:3: b: value '-2': must be greater than 0");
}

TEST(TextSource, NamesFilesThatAreNoText) {
  const auto read_bytes = [](const std::string& bytes) { return refusal_of([&] { TextSource("f", bytes); }); };
  EXPECT_THAT(read_bytes(std::string("\xff\xfet\0i\0m\0e\0", 10)),
              HasSubstr("f: no plain text: it is a text in UTF-16"));
  EXPECT_THAT(read_bytes(std::string("t\0i\0m\0e\0", 8)), HasSubstr("UTF-16"));
  EXPECT_THAT(read_bytes(std::string("\0t\0i\0m\0e", 8)), HasSubstr("UTF-16"));
  EXPECT_THAT(read_bytes("PK\x03\x04..."), HasSubstr("a zip archive, as are the workbooks of Excel"));
  EXPECT_THAT(read_bytes("\x89HDF\r\n\x1a\n"), HasSubstr("HDF5"));
  EXPECT_THAT(read_bytes(std::string("\x02\0\x05\0\0\0", 6)), HasSubstr("OpenFAST (.outb): set OutFileFmt to 1"));
  EXPECT_EQ(read_bytes(std::string("time_s\n1\x1b[2J\n")),
            "f:2: byte 0x1b: no plain text, a binary file or a damaged one");
  EXPECT_EQ(read_bytes("caf\xe9\n"), "accepted");
  EXPECT_EQ(TextSource("f", "caf\xe9").text(), "caf\xc3\xa9");
}

TEST(TextSource, CountsLinesAndCharacters) {
  const TextSource source("f", "a\nb \xc2\xb0 c\n");
  EXPECT_EQ(source.place(source.text().substr(source.text().find('c'))), "f:2:5");
}

// Deterministic fuzzing: tables with changed bytes and pieces are read, or refused with an InputError of bounded
// length.

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

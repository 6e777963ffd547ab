// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/json.h"
#include "sim/core/text/names.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using ::testing::ElementsAre;

std::string json_refusal(const std::string& json) {
  return refusal_of([&] { check_json(json, "m.json", 3); });
}

TEST(RepeatedKeys, AreRefusedInEveryObject) {
  EXPECT_EQ(json_refusal(R"({"a": 1, "b": 2, "a": 3})"), "m.json: the key 'a' appears twice in an object");
  EXPECT_EQ(json_refusal(R"([{"x": {"a": 1, "\u0061": 3}}])"), "m.json: the key 'a' appears twice in an object");
  EXPECT_EQ(json_refusal("{\"\\u001b\": 1, \"\\u001b\": 2}"), "m.json: the key '\\x1b' appears twice in an object");
}

TEST(RepeatedKeys, AreNotThoseOfDifferentObjects) {
  EXPECT_EQ(json_refusal(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}]})"), "accepted");
  for (const char* no_json : {"", "{", "{\"a\": 1,", "{\"a\" 1}", "]"}) EXPECT_EQ(json_refusal(no_json), "accepted");
}

TEST(RepeatedKeys, AreCheckedInObjectsOfLimitedSizeAndDepth) {
  EXPECT_EQ(json_refusal(R"({"a": 1, "b": 2, "c": [{"d": 1}]})"), "accepted");
  EXPECT_EQ(json_refusal(R"({"a": 1, "b": 2, "c": 3, "d": 4})"), "m.json: an object has more than 3 keys");
  EXPECT_EQ(json_refusal(std::string(64, '[') + std::string(64, ']')), "accepted");
  EXPECT_EQ(json_refusal(std::string(65, '[') + std::string(65, ']')),
            "m.json: the JSON is nested more than 64 levels deep");
  EXPECT_EQ(json_refusal(R"({"a": )" + std::string(200'000, '[')),
            "m.json: the JSON is nested more than 64 levels deep");
}

// Named files are found in the folder that is given, the working directory and the data of the program, in this order;
// a name that finds none is refused with the one that it means.

namespace fs = std::filesystem;

class NamedFile : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"given", "here", "data/scenarios"}) fs::create_directories(root() / name);
    fs::current_path(root() / "here");
    set_data_folder(root() / "data");
  }
  void TearDown() override {
    fs::current_path(before_);
    set_data_folder(data_before_);
  }
  fs::path root() const { return folder_.path(); }
  void make(const std::string& name) const { write_file(root() / name, "x"); }

  const fs::path before_ = fs::current_path(), data_before_ = data_folder();
  const TemporaryFolder folder_;
};

TEST_F(NamedFile, IsSearchedInTheDataOfTheProgramLast) {
  const auto found = [&] { return find_file("a", root() / "given", "key"); };
  EXPECT_EQ(refusal_of(found), fmt::format("key: value 'a': no such file, neither in {0}/given nor in the working "
                                           "directory nor in {0}/data",
                                           root().string()));
  make("data/a");
  EXPECT_EQ(found(), root() / "data/a");
  make("here/a");
  EXPECT_EQ(found(), "a");
  make("given/a");
  EXPECT_EQ(found(), root() / "given/a");
  EXPECT_EQ(find_file("a", "", "key"), "a");
  EXPECT_EQ(refusal_of([&] { find_file("/none/a", root() / "given", "key"); }), "key: value '/none/a': no such file");
}

TEST_F(NamedFile, OfAScenarioNeedsNoFolder) {
  make("data/scenarios/quick.yaml");
  EXPECT_EQ(find_input("quick.yaml", "scenarios"), root() / "data/scenarios/quick.yaml");
  EXPECT_EQ(find_input("scenarios/quick.yaml", "scenarios"), root() / "data/scenarios/quick.yaml");
  EXPECT_EQ(refusal_of([&] { find_input("quick.yaml"); }),
            fmt::format("quick.yaml: no such file, neither in the working directory nor in {}/data: did you mean "
                        "'scenarios/quick.yaml'?",
                        root().string()));
  make("here/quick.yaml");
  EXPECT_EQ(find_input("quick.yaml", "scenarios"), "quick.yaml");
  set_data_folder("");
  EXPECT_EQ(refusal_of([&] { find_input("none", "scenarios"); }), "none: no such file, not in the working directory");
}

TEST_F(NamedFile, ThatIsMisspeltIsSuggestedAsItMustBeWritten) {
  for (const char* folder : {"data/assets/materials", "given/meshes"}) fs::create_directories(root() / folder);
  for (const char* file : {"data/assets/combatant_144m.glb", "data/assets/materials/steel.yaml", "given/hull.obj",
                           "given/meshes/decoy.stl", "given/.secret.obj", "data/scenarios/quick.yaml"})
    make(file);
  const std::pair<const char*, const char*> meant[] = {{"combatant_144.glb", "assets/combatant_144m.glb"},
                                                       {"combatant_144m.stl", "assets/combatant_144m.glb"},
                                                       {"asset/combatant_144m.glb", "assets/combatant_144m.glb"},
                                                       {"hul.obj", "hull.obj"},
                                                       {"decoy.stl", "meshes/decoy.stl"},
                                                       {"meshes/decoi.stl", "meshes/decoy.stl"},
                                                       {"assets/materials/stel.yaml", "assets/materials/steel.yaml"}};
  for (const auto& [written, right] : meant) {
    const std::string message = refusal_of([&name = written, this] { find_file(name, root() / "given", "key"); });
    EXPECT_TRUE(message.ends_with(fmt::format("/data: did you mean '{}'?", right))) << message;
    EXPECT_NE(find_file(right, root() / "given", "key"), fs::path());
  }
  EXPECT_EQ(refusal_of([&] { find_file((root() / "given/hall.obj").string(), "", "key"); }),
            fmt::format("key: value '{0}/given/hall.obj': no such file: did you mean '{0}/given/hull.obj'?",
                        root().string()));
  for (const char* far : {"secret.obj", "frigate.glb"})
    EXPECT_TRUE(refusal_of([&] { find_file(far, root() / "given", "key"); }).ends_with("/data")) << far;
  const std::string scenario = refusal_of([] { find_input("quik.yaml", "scenarios"); });
  EXPECT_TRUE(scenario.ends_with("/scenarios: did you mean 'scenarios/quick.yaml'?")) << scenario;
}

TEST(DataFolder, IsTheSourceTreeOfAProgramInItsBuildFolder) {
  EXPECT_TRUE(std::filesystem::equivalent(data_folder(), SEAGLINT_SOURCE_DIR)) << data_folder();
}

// A misspelt word means the name that is nearest to it, with or without its unit, or that begins with it.

const std::vector<std::string> kRadar{"carrier_ghz",   "hop_count",      "hop_step_mhz", "hop_code",
                                      "bandwidth_mhz", "pulse_width_us", "sampling_mhz", "pri_us",
                                      "pri_jitter_us", "pulses"};

TEST(Suggestion, IsTheNearestNameByLettersOrByTheNameWithoutItsUnit) {
  const std::pair<const char*, const char*> meant[] = {{"carier_ghz", "carrier_ghz"},
                                                       {"pulse", "pulses"},
                                                       {"bandwidth", "bandwidth_mhz"},
                                                       {"carrier", "carrier_ghz"},
                                                       {"bandwidth_hz", "bandwidth_mhz"},
                                                       {"Pulse_Width", "pulse_width_us"},
                                                       {"pri", "pri_us"},
                                                       {"pri_s", "pri_us"},
                                                       {"bandwith", "bandwidth_mhz"},
                                                       {"sampling_rate_mhz", "sampling_mhz"},
                                                       {"jitter", "pri_jitter_us"},
                                                       {"hop_step_hz", "hop_step_mhz"}};
  for (const auto& [word, name] : meant)
    EXPECT_EQ(suggestion(word, kRadar), "did you mean '" + std::string(name) + "'?");
  EXPECT_EQ(suggestion("--frequency", {"--frequency-ghz", "--facets"}), "did you mean '--frequency-ghz'?");
  EXPECT_EQ(suggestion("bandwidth", {"radar.bandwidth_mhz", "sea.gamma"}), "did you mean 'radar.bandwidth_mhz'?");
}

TEST(Suggestion, NamesSeveralThatBeginWithTheWord) {
  EXPECT_EQ(suggestion("hop", kRadar), "did you mean 'hop_count', 'hop_step_mhz' or 'hop_code'?");
}

TEST(Suggestion, IsTheWholeListWhenNoNameIsNear) {
  EXPECT_EQ(suggestion("colour", {"a", "b"}), "must be one of a, b");
  EXPECT_EQ(near_suggestion("colour", {"a", "b"}), std::nullopt);
  EXPECT_EQ(near_suggestion(std::string(10000, 'a'), {"a"}), std::nullopt);
  EXPECT_EQ(near_suggestion("", {}), std::nullopt);
}

std::string complaint_about(const std::string& range) {
  return refusal_of([&] { parse_range(range); });
}

TEST(Number, IsReadCompletelyOrNotAtAll) {
  EXPECT_EQ(parse_number("16"), 16.0);
  EXPECT_EQ(parse_number("-0.5"), -0.5);
  EXPECT_EQ(parse_number("+2.5e3"), 2500.0);
  EXPECT_EQ(parse_number("1e-300"), 1e-300);
  for (const char* text : {"", " ", "+", "-", "+-1", "++1", "1 ", " 1", "1x", "0x10", "1e999", "inf", "-inf", "nan",
                           ".nan", "1,5", "1_000"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(Number, OfFormatsThatDefineThemMayBeInfinityOrNan) {
  EXPECT_EQ(parse_any_number("-1.5"), -1.5);
  EXPECT_EQ(parse_any_number("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(parse_any_number("NaN").value()));
  for (const char* text : {"", "+-1", "inf1", "nanx", "0x1p3", "0x1p3zzz"})
    EXPECT_FALSE(parse_any_number(text)) << text;
}

TEST(Number, OfAnIntegerHasDigitsOnly) {
  EXPECT_EQ(parse_integer("-12"), -12);
  EXPECT_EQ(parse_integer("+3"), 3);
  EXPECT_EQ(parse_natural("18446744073709551615"), 18446744073709551615ull);
  for (const char* text : {"", "+", "+-1", "--1", "1/xyz", "0.5", "1.0", "1e3", "0x1p3zzz", "9223372036854775808"})
    EXPECT_FALSE(parse_integer(text)) << text;
  EXPECT_FALSE(parse_natural("-1"));
}

TEST(Range, IncludesBothEnds) {
  EXPECT_THAT(parse_range("10:170:40"), ElementsAre(10, 50, 90, 130, 170));
  EXPECT_THAT(parse_range("5"), ElementsAre(5));
  EXPECT_THAT(parse_range("3:3:1"), ElementsAre(3));
  EXPECT_THAT(parse_range("2:-2:-2"), ElementsAre(2, 0, -2));
  EXPECT_THAT(parse_range("10:15:2"), ElementsAre(10, 12, 14));
}

TEST(Range, EndsExactlyAtItsEnd) {
  // Sums of 0.1 differ from 0.3, 0.7 and 1 by rounding; the end must neither be lost nor be doubled.
  for (int last = 1; last <= 1000; ++last) {
    const std::string end = std::to_string(last / 10) + "." + std::to_string(last % 10);
    const std::vector<double> values = parse_range("0:" + end + ":0.1");
    ASSERT_EQ(values.size(), static_cast<std::size_t>(last) + 1) << end;
    EXPECT_EQ(values.back(), std::stod(end));
  }
}

// Values are the doubles of their decimal digits, as `azimuth_deg == 0.3` compares them; sums of doubles give
// 0.30000000000000004.
TEST(Range, HasTheValuesOfItsDecimals) {
  for (const auto& [text, decimals] : {std::pair{"0.1:1.5:0.1", 1},
                                       {"0:0.5:0.1", 1},
                                       {"-2:2:0.05", 2},
                                       {"9.3:9.5:0.001", 3},
                                       {"1e-3:9e-3:1e-3", 3},
                                       {"170:-170:-0.7", 1},
                                       {"0.001:1:1e-6", 6},
                                       {"5:6:.01", 2}})
    for (const double value : parse_range(text))
      EXPECT_EQ(value, std::stod(fmt::format("{:.{}f}", value, decimals))) << text;
  EXPECT_THAT(parse_range("0:4e20:2e20"), ElementsAre(0, 2e20, 4e20));
  // Digits beyond those of a double are summed as doubles.
  EXPECT_THAT(parse_range("0.12345678901234567:1:0.5"), ElementsAre(0.12345678901234567, 0.62345678901234567));
}

TEST(Range, ReportsErrors) {
  EXPECT_EQ(complaint_about("1:2"), "value '1:2': must be a number or from:to:step");
  EXPECT_EQ(complaint_about("1:2:3:4"), "value '1:2:3:4': must be a number or from:to:step");
  EXPECT_EQ(complaint_about("a:2:1"), "value 'a:2:1': must be a number or from:to:step");
  EXPECT_EQ(complaint_about(""), "value '': must be a number or from:to:step");
  EXPECT_EQ(complaint_about("::"), "value '::': must be a number or from:to:step");
  EXPECT_EQ(complaint_about("1:2:0"), "value '1:2:0': must be from:to:step with a step other than 0");
  EXPECT_EQ(complaint_about("1:2:-1"),
            "value '1:2:-1': must be from:to:step with a step that leads from the first value to the second");
  EXPECT_EQ(complaint_about("0:1:1e-9"), "value '0:1:1e-9': must be a range of at most 1000000 values");
  EXPECT_EQ(complaint_about("-1e308:1e308:1e-308"),
            "value '-1e308:1e308:1e-308': must be a range of at most 1000000 values");
}

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
  EXPECT_HAS(table_refusal("time_s;roll_deg\n0;1.234,5\n1;2\n"), "t.csv:2:3: roll_deg: value '1.234,5'");
  EXPECT_HAS(table_refusal("time_s;roll_deg\n0;1,234,567\n1;2\n"), "must be a finite number");
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
  EXPECT_HAS(table_refusal("time_s,roll_deg\n0,\"1.5\"x\n0.5,2\n"), "t.csv:2:3: a quote");
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
    EXPECT_HAS(table_refusal(std::string("time_s,roll_deg\n0,1\n1,") + cell + "\n2,2\n"),
               std::string("t.csv:3:3: roll_deg: value '") + cell + "': must be a finite number");
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
  EXPECT_HAS(read_bytes(std::string("\xff\xfet\0i\0m\0e\0", 10)), "f: no plain text: it is a text in UTF-16");
  EXPECT_HAS(read_bytes(std::string("t\0i\0m\0e\0", 8)), "UTF-16");
  EXPECT_HAS(read_bytes(std::string("\0t\0i\0m\0e", 8)), "UTF-16");
  EXPECT_HAS(read_bytes("PK\x03\x04..."), "a zip archive, as are the workbooks of Excel");
  EXPECT_HAS(read_bytes("\x89HDF\r\n\x1a\n"), "HDF5");
  EXPECT_HAS(read_bytes(std::string("\x02\0\x05\0\0\0", 6)), "OpenFAST (.outb): set OutFileFmt to 1");
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
        for (std::size_t row = 0; row < table.rows(); ++row)
          for (std::size_t column = 0; column < 3; ++column) ASSERT_TRUE(std::isfinite(table.number(row, column)));
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

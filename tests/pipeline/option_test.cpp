// SPDX-License-Identifier: BSD-3-Clause
// Command-line arguments: numbers, misspelt words, options that belong to other commands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

using Words = std::vector<std::string>;

class Options : public testing::Test {
 protected:
  void expect_refused(Words words, const Words& more, const std::string& message) const {
    words.insert(words.end(), more.begin(), more.end());
    SCOPED_TRACE(testing::PrintToString(words));
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, StartsWith("seaglint: "));
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(fs::is_empty(folder_.path()));
  }
  Words rcs() const {
    return {"rcs", "--target", "assets/icosahedral_reflector.glb", "--frequency-ghz", "10", "--azimuth-deg",
            "0",   "-o",       folder_.path() / "rcs.csv"};
  }
  Words plate() const { return {"mesh", "make", "plate", "-o", folder_.path() / "plate.obj"}; }

  TemporaryFolder folder_;
};

// 010 is ten, neither octal nor an error.
TEST_F(Options, NumbersAreDecimal) {
  Words words = rcs();
  words.insert(words.end(), {"--max-bounces", "010", "--wavefront-range-m", "0100"});
  ASSERT_EQ(run_program(words).code, 0);
  EXPECT_THAT(read_file(folder_.path() / "rcs.csv"),
              testing::AllOf(HasSubstr("max_bounces 10,"), HasSubstr("wavefront_range_m 100 ")));
  words = {"mesh", "make", "cylinder", "--segments", "+012", "-o", folder_.path() / "c.stl"};
  ASSERT_EQ(run_program(words).code, 0);
  EXPECT_EQ(fs::file_size(folder_.path() / "c.stl"), 84u + 50u * 4 * 12);  // two of each side, one of each end
}

TEST_F(Options, OfNumbersAcceptNothingElse) {
  for (const std::string value : {"0x10", "2.0", "1e3", "abc", ""}) {
    const std::string quoted = value.empty() ? "''" : value;
    expect_refused(rcs(), {"--max-bounces", value},
                   "--max-bounces: value " + quoted + ": must be a whole number (see seaglint rcs --help)\n");
  }
  expect_refused(rcs(), {"--threads", "0x1"}, "--threads: value 0x1: must be a whole number (");
  expect_refused({"mesh", "make", "sphere", "-o", folder_.path() / "s.stl"}, {"--subdivisions", ""},
                 "--subdivisions: value '': must be a whole number (");
  expect_refused({"map", "scenarios/points.yaml", "-o", folder_.path() / "m.png"}, {"--sample", "0x1"},
                 "--sample: value 0x1: must be a whole number, 0 or more (");
  for (const std::string value : {"0x10", "abc", "", "inf", "nan"}) {
    const std::string quoted = value.empty() ? "''" : value;
    expect_refused(plate(), {"--length-m", value},
                   "--length-m: value " + quoted + ": must be a number (see seaglint mesh make plate --help)\n");
  }
  expect_refused(rcs(), {"--wavefront-range-m", ""}, "--wavefront-range-m: value '': must be within 0 and");
  expect_refused(rcs(), {"--transmit-azimuth-deg", "0x10"}, "--transmit-azimuth-deg: value 0x10: must be within");
  expect_refused(rcs(), {"--elevation-deg", "0x10"}, "--elevation-deg: value '0x10': must be");
  expect_refused({"mesh", "make", "dihedral", "-o", folder_.path() / "d.obj"}, {"--opening-deg", "180"},
                 "dihedral opening: 180 deg must be greater than 0 and less than 180 deg\n");
  expect_refused(plate(), {"--length-m", "1e308"}, "plate length: 1e+308 m is outside 1e-20..1e+07 m\n");
}

// Reported before missing files or other missing input.
TEST_F(Options, AndCommandsThatAreMisspeltAreNamed) {
  expect_refused({"rcs", "--targt", "x"}, {},
                 "seaglint: unknown option '--targt': did you mean '--target'? (see seaglint rcs --help)\n");
  expect_refused({"rcs", "--targt=x", "--max-bounces", "abc"}, {},
                 "unknown option '--targt': did you mean '--target'?");
  expect_refused({"check", "scenarios/points.yaml", "--sets", "x=1"}, {},
                 "unknown option '--sets': did you mean '--set'? (see seaglint check --help)\n");
  expect_refused({"check", "--nothing-like-it"}, {},
                 "unknown option '--nothing-like-it' (see seaglint check --help)\n");
  expect_refused({"mesh", "make", "foo"}, {}, "unknown command 'foo': must be one of ship, ");
  expect_refused({"mesh", "make", "plte", "--length-m", "2"}, {},
                 "unknown command 'plte': did you mean 'plate'? (see seaglint mesh make --help)\n");
  expect_refused({"mesh", "mkae"}, {}, "unknown command 'mkae': did you mean 'make'? (see seaglint mesh --help)\n");
  expect_refused({"mesh", "make"}, {}, "A subcommand is required (see seaglint mesh make --help)\n");
  expect_refused({"check", "scenarios/points.yaml", "other.yaml"}, {}, "other.yaml");
}

TEST_F(Options, ThatNeedOthersNameThem) {
  const Words sea{"sea", "scenarios/points.yaml", "-o", folder_.path() / "sea.csv"};
  expect_refused(sea, {"--realisations", "2"},
                 "--realisations requires --spectrum or --figure (see seaglint sea --help)\n");
  expect_refused(rcs(), {"--transmit-elevation-deg", "2"},
                 "--transmit-elevation-deg requires --transmit-azimuth-deg (see seaglint rcs --help)\n");
}

}  // namespace
}  // namespace seaglint

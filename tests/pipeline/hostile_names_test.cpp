// SPDX-License-Identifier: BSD-3-Clause
// Names in a user's files are commands to nothing: not to the terminal, a spreadsheet, a Markdown page or gnuplot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A plate of one part, seen square from ahead.
std::string plate_of(const std::string& part) { return "v 0 0 0\nv 0 1 0\nv 0 0 1\ng " + part + "\nf 1 2 3\n"; }

bool has_control_characters(const std::string& text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return c != '\n' && static_cast<unsigned char>(c) < 0x20; });
}

TEST(HostileNames, OfPartsAreCellsOfCsv) {
  const TemporaryFolder folder;
  const fs::path mesh = folder.path() / "plate.obj", centres = folder.path() / "centres.csv";
  write_file(mesh, plate_of("=cmd|calc,\"x"));
  const ProgramResult result =
      run_program({"rcs", "--target", mesh, "--frequency-ghz", "1", "--azimuth-deg", "0", "--elevation-deg", "0",
                   "--export-scattering-centres", centres, "-o", folder.path() / "rcs.csv"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(read_file(centres), HasSubstr(",\"'=cmd|calc,\"\"x\",1,"));
}

TEST(HostileNames, NeverReachTheTerminalAsBytes) {
  const TemporaryFolder folder;
  const fs::path mesh = folder.path() / "plate.obj", scenario = folder.path() / "s.yaml";
  write_file(mesh, plate_of("\x1b]0;title\x07\xff"));
  const ProgramResult info = run_program({"mesh", "info", mesh});
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("\\x1b]0;title\\x07"));
  EXPECT_FALSE(has_control_characters(info.out));
  write_file(scenario, "seaglint: 1\nname: \"a\\e[31m\"\n");
  const ProgramResult refused = run_program({"check", scenario});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("\\x1b[31m"));
  EXPECT_FALSE(has_control_characters(refused.err));
}

TEST(HostileNames, AreEscapedInDataCards) {
  const TemporaryFolder folder;
  const fs::path data = folder.path() / "data";
  const ProgramResult made =
      run_program({"generate", "scenarios/points.yaml", "--set", "dataset.maps_per_case=2", "--set",
                   "dataset.realisations_per_case=1", "--set", "name=a` <script>alert(1)</script> |", "-o", data});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(read_file(data / "README.md"), testing::StartsWith("# Data set `` a` <script>alert(1)</script> | ``\n"));
}

}  // namespace
}  // namespace seaglint

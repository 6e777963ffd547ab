// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "tests/pipeline/program.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

// For every wrong input each command reports one line, exits with the documented code and leaves no file.

// Contents of every file below a folder; empty for a folder.
std::map<std::string, std::string> files_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path()] = entry.is_regular_file() ? read_file(entry.path()) : std::string();
  return files;
}

// Runs the program, which must fail with one line that contains `message` and leave the folder unchanged.
void expect_failure(const fs::path& folder, const Words& words, int code, const std::string& message) {
  SCOPED_TRACE(testing::PrintToString(words));
  const std::map<std::string, std::string> before = files_below(folder);
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.code, code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, StartsWith("seaglint: "));
  EXPECT_HAS(result.err, message);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_TRUE(files_below(folder) == before);
}

// The commands that read a scenario, with the output in `output` where they have one.
std::vector<Words> scenario_commands(const std::string& scenario, const fs::path& output) {
  return {{"check", scenario},
          {"sea", scenario, "-o", output / "sea.csv"},
          {"motion", scenario, "-o", output / "motion.csv"},
          {"echo", scenario, "-o", output / "echo.npz"},
          {"map", scenario, "-o", output / "map.png"},
          {"generate", scenario, "-o", output / "data"},
          {"run", scenario, "-o", output / "run"}};
}

// Those of them that need the echo of its targets.
std::vector<Words> solving_commands(const std::string& scenario, const fs::path& output) {
  return {
      {"check", scenario}, {"map", scenario, "-o", output / "map.png"}, {"generate", scenario, "-o", output / "data"}};
}

// A folder with a scenario of two meshes, one of which is a shipped asset cut in half.
class InputErrors : public testing::Test {
 protected:
  InputErrors() {
    const std::string whole = read_file(SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb");
    write_file(folder() / "whole.glb", whole);
    write_file(folder() / "truncated.glb", whole.substr(0, whole.size() / 2));
  }
  const fs::path& folder() const { return folder_.path(); }
  std::string scenario(const std::string& lines, const std::string& mesh = "whole.glb") const {
    const fs::path file = folder() / "scenario.yaml";
    write_file(file, "seaglint: 1\n" + lines +
                         "targets:\n  ship: {label: 1, mesh: whole.glb}\n  array: {label: 0, mesh: " + mesh + "}\n");
    return file;
  }
  // A sweep of the mesh, which ends before its first direction.
  Words rcs(const Words& more, const std::string& mesh = "whole.glb") const {
    return with({"rcs", "--target", folder() / mesh, "--frequency-ghz", "10", "--azimuth-deg", "0"}, more);
  }
  void expect_failures(const std::vector<Words>& commands, const std::string& message) const {
    for (const Words& words : commands) expect_failure(folder(), words, 2, message);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(InputErrors, OfATypoInAKey) {
  expect_failures(scenario_commands(scenario("sea: {peek_period_s: 8}\n"), folder()),
                  "scenario.yaml:2:7: sea.peek_period_s: unknown key: did you mean 'peak_period_s'?\n");
}

TEST_F(InputErrors, OfANegativeWaveHeight) {
  expect_failures(scenario_commands(scenario("sea: {significant_wave_height_m: -1}\n"), folder()),
                  "scenario.yaml:2:34: sea.significant_wave_height_m: value '-1': must be a number");
}

// The sea contains no targets: `sea` reads no mesh.
TEST_F(InputErrors, OfAMeshThatIsMissingOrCutShort) {
  for (const std::string mesh : {"none.glb", "truncated.glb"}) {
    for (const Words& words : scenario_commands(scenario("", mesh), folder()))
      if (words.front() != "sea") expect_failure(folder(), words, 2, mesh);
    expect_failures({{"mesh", "info", folder() / mesh, "--picture", folder() / "mesh.png"},
                     rcs({"-o", folder() / "rcs.csv"}, mesh)},
                    mesh + ": ");
  }
}

// The 144 m ship extends 72 m from its origin; the second order of the wavefront needs ten times that range.
TEST_F(InputErrors, OfAWavefrontRangeTooShort) {
  for (const Words& words :
       {Words{"check", "scenarios/quick.yaml"}, {"generate", "scenarios/quick.yaml", "-o", folder() / "data"}})
    expect_failures({with(words, {"--set", "targets.ship.solver.wavefront_range_m=500"})},
                    "targets.ship.solver: wavefront range 500 m");
}

// Four reflectors 40 m apart extend to 60.5 m, wherever the origin of each; the extent of a companion includes its
// distance.
TEST_F(InputErrors, OfAWavefrontRangeTooShortForALayoutOrACompanion) {
  write_file(
      folder() / "near.yaml",
      "seaglint: 1\ntargets:\n"
      "  ship: {label: 1, mesh: assets/icosahedral_reflector.glb, companions: [{target: decoy, x_m: 0, y_m: 60}], "
      "solver: {wavefront_range_m: 400}}\n"
      "  decoy: {label: 0, mesh: assets/icosahedral_reflector.glb, solver: {wavefront_range_m: 400}}\n"
      "  array: {label: 0, mesh: assets/icosahedral_reflector.glb, layout: {line: {count: 4, spacing_m: 40}}}\n");
  const std::string file = folder() / "near.yaml";
  for (const Words& words : solving_commands(file, folder())) {
    expect_failures({words},
                    "near.yaml:3:72: targets.ship.companions.0: wavefront range 400 m: must be at least ten "
                    "times the target radius of 60.5 m");
    expect_failures(
        {with(words, {"--set", "targets.array.solver.wavefront_range_m=600"})},
        "targets.array.solver: wavefront range 600 m: must be at least ten times the target radius of 60.5 m");
  }
  completed({"check", file, "--set", "targets.ship.solver.wavefront_range_m=610", "--set",
             "targets.decoy.solver.wavefront_range_m=610", "--set", "targets.array.solver.wavefront_range_m=610"});
}

// For a scenario of which no sample can be generated, `generate` leaves no file, so that a corrected scenario can
// follow.
TEST_F(InputErrors, OfASeriesThatDoesNotCoverTheIntervals) {
  std::string series = "time_s,roll_deg,pitch_deg,yaw_deg\n";
  for (int t = 0; t <= 40; ++t) series += std::to_string(t) + ",0,0,0\n";
  write_file(folder() / "series.csv", series);
  const std::string file = folder() / "series.yaml";
  write_file(file,
             "seaglint: 1\ntargets:\n  ship: {label: 1, mesh: whole.glb, motion: {model: series, file: series.csv}}\n"
             "dataset: {maps_per_case: 4, realisations_per_case: 2}\n");
  for (const char* start : {"35", "-5", "1e6"}) {
    for (const Words& words : solving_commands(file, folder()))
      expect_failures({with(words, {"--set", std::string("targets.ship.motion.series_start_s=") + start})},
                      "targets.ship.motion.series_start_s: value ");
  }
  completed({"check", file});
}

TEST_F(InputErrors, OfATargetUnderWater) {
  const std::string file = folder() / "water.yaml";
  write_file(
      file,
      "seaglint: 1\nsea_reflection: {enabled: true}\ntargets:\n"
      "  array: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float, origin_above_waterline_m: "
      "-10}}\n");
  for (const char* reflects : {"true", "false"}) {
    for (const Words& words : solving_commands(file, folder()))
      expect_failures(
          {with(words, {"--set", std::string("sea_reflection.enabled=") + reflects})},
          "water.yaml:4:110: targets.array.motion.origin_above_waterline_m: value -10: must be greater than ");
  }
}

// That a plate does not return this polarisation is found only by tracing it.
TEST_F(InputErrors, OfATargetWithoutAnEcho) {
  const std::string plate = folder() / "plate.obj", file = folder() / "plate.yaml";
  write_file(plate, "v 0 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  write_file(file,
             "seaglint: 1\nradar: {polarisation: hv}\nview: {azimuth_deg: 0, elevation_deg: 0}\ntargets:\n  plate: "
             "{label: 1, mesh: plate.obj, solver: {edges: false}}\n");
  const auto before = files_below(folder());
  const ProgramResult result = run_program({"generate", file, "-o", folder() / "data"});
  EXPECT_EQ(result.code, 2);
  // after a warning of its open edges
  EXPECT_HAS(result.err, "\nseaglint: " + file + ":5:10: targets.plate: sample ");
  EXPECT_HAS(result.err, "has no power");
  EXPECT_TRUE(files_below(folder()) == before);
}

TEST_F(InputErrors, OfANumberThatIsNotANumber) {
  const std::string mesh = folder() / "whole.glb", csv = folder() / "rcs.csv";
  for (const char* option : {"--wavefront-range-m", "--min-patch-m", "--transmit-azimuth-deg", "--centre-cell-m"})
    expect_failures({rcs({"-o", csv, option, "nan"})}, std::string(option) + ": value nan: must be within");
  for (const char* angle : {"nan", "61", "-1", "smooth"})
    expect_failures({rcs({"-o", csv, "--crease-deg", angle})},
                    std::string("value ") + angle + ": must be auto or within 0 and 60");
  expect_failures({{"mesh", "info", mesh, "--min-wedge-angle-deg", "nan"}}, "value nan");
  expect_failures({{"map", kPoints, "--sample", "-1", "-o", folder() / "map.png"}}, "-1");
}

// Bounds and references to help are those of the command that was called.
TEST_F(InputErrors, OfAnOptionWithItsBoundsAndHelp) {
  for (const char* value : {"-1", "2.5", "1e3", "99999999999999999999"}) {
    for (const Words& words : {Words{"map", kPoints, "-o", folder() / "map.png"},
                               {"echo", kPoints, "-o", folder() / "e.npz"},
                               {"regenerate", folder()}})
      expect_failures({with(words, {"--sample", value})}, std::string("--sample: value ") + value +
                                                              ": must be a whole number, 0 or more (see seaglint " +
                                                              words[0] + " --help)\n");
  }
  expect_failures({{"mesh", "make", "sphere", "--diameter-m", "1"}}, "(see seaglint mesh make sphere --help)\n");
  expect_failures({{"mesh", "info"}}, "(see seaglint mesh info --help)\n");
  expect_failure(folder(), {"verify", std::string(300, 'x')}, 1, "xxx/manifest.json: File name too long\n");
}

// Names of parts and values of files that a terminal would obey are shown, not sent.
TEST_F(InputErrors, AndFindingsSendNoByteOfAFileToTheTerminal) {
  write_file(folder() / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng x\x1b[31m\nf 1 2 3\n");
  const ProgramResult info = completed({"mesh", "info", folder() / "a.obj"});
  EXPECT_HAS(info.out, "x\\x1b[31m");
  EXPECT_EQ(info.out.find('\x1b'), std::string::npos);
  write_file(folder() / "b.obj", "v \x1b[2J\xc2\x9b 0 0\n");
  expect_refused({"mesh", "info", folder() / "b.obj"}, "b.obj:1: \"\\x1b[2J\\xc2\\x9b\" is not a coordinate");
}

TEST_F(InputErrors, OfAFullStandardOutput) {
  for (const char* words : {"--help", "--version", "rcs --help"}) {
    const ProgramResult result =
        run_words({"/bin/bash", "-c", std::string("exec \"$0\" ") + words + " >/dev/full", kProgram});
    EXPECT_EQ(result.code, 1) << words;
    EXPECT_EQ(result.err, "seaglint: standard output: cannot write: No space left on device\n") << words;
  }
}

// A directory with other contents cannot be resumed.
TEST_F(InputErrors, OfResumingAmongOtherFiles) {
  make_directory(folder() / "other");
  write_file(folder() / "other" / "notes.txt", "mine");
  for (const char* command : {"generate", "run"})
    expect_failure(folder(), {command, kPoints, "-o", folder() / "other", "--resume"}, 2,
                   "other: the directory contains");
}

// An output must not overwrite an input, by whatever name and key the input is given.
TEST_F(InputErrors, OfWritingOverAnInput) {
  const std::string mesh = folder() / "whole.glb", file = scenario(""), rao = folder() / "rao.csv",
                    link = folder() / "link.glb";
  write_file(rao, "none");
  fs::create_symlink(mesh, link);
  expect_failures({rcs({"-o", mesh}),
                   rcs({"-o", link}),
                   rcs({"-o", rao, "--reference", rao}),
                   rcs({"-o", folder() / "rcs.csv", "--export-scattering-centres", folder() / "." / "whole.glb"}),
                   {"mesh", "info", mesh, "--picture", mesh},
                   {"sea", file, "-o", file},
                   {"motion", file, "-o", file},
                   {"motion", file, "-o", mesh},
                   {"motion", file, "-o", rao, "--rao", folder() / "rao.png", "--rao-reference", rao}},
                  "is read here, and would be written over");
}

TEST_F(InputErrors, OfTwoOutputsInOneFile) {
  const std::string file = scenario(""), csv = folder() / "out.csv", png = folder() / "out.png";
  expect_failures({{"sea", file, "-o", csv, "--spectrum", csv, "--realisations", "2"},
                   {"motion", file, "-o", csv, "--spectrum", folder() / "." / "out.csv"},
                   {"motion", file, "-o", csv, "--figure", png, "--snapshots", png},
                   rcs({"-o", csv, "--export-scattering-centres", csv})},
                  "would be written twice");
}

TEST_F(InputErrors, OfAnEndingOfAnotherFormat) {
  expect_failures({{"echo", kPoints, "-o", folder() / "echo.csv"}}, "echo.csv: NumPy's archives end in .npz");
  for (const char* name : {"ship.jpg", "ship.svg", "ship"})
    expect_failures({{"mesh", "info", folder() / "whole.glb", "--picture", folder() / name}},
                    std::string(name) + ": the name of a mesh's picture ends in .png");
  expect_failures({{"regenerate", folder(), "--sample", "0", "-o", folder() / "sample"}},
                  "sample: NumPy's archives end in .npz");
  expect_failures({rcs({"-o", folder() / "rcs.csv", "--export-hot-spots", folder() / "spots.obj"})},
                  "spots.obj: hot spots need the ending .html (page)");
}

// The shell's limit is in units of 1024 bytes; by default the system kills a program that exceeds it.
TEST_F(InputErrors, OfALimitOnFileSizes) {
  const auto limited = [&](const Words& words) {
    SCOPED_TRACE(words.front());
    const ProgramResult result =
        run_words(with({"/bin/bash", "-c", "ulimit -f 20; exec \"$@\"", "limited", kProgram}, words));
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err, testing::AllOf(HasSubstr("cannot write"), HasSubstr("File too large")));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  const auto before = files_below(folder());
  limited({"mesh", "make", "sphere", "-o", folder() / "sphere.obj"});
  EXPECT_TRUE(files_below(folder()) == before);
  limited({"generate", kPoints, "-o", folder() / "data"});
  EXPECT_THAT(names_in(folder() / "data"), testing::ElementsAre("scenario.yaml"));
}

// Below a file and in /proc no user can write, not even root; a folder without write permission stops all other users.
TEST_F(InputErrors, OfAPlaceThatCannotBeWritten) {
  const fs::path locked = folder() / "locked";
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
  std::vector<fs::path> places{folder() / "whole.glb", "/proc"};
  if (::geteuid() != 0) places.push_back(locked);
  for (const fs::path& place : places) {
    for (const Words& words : scenario_commands(kPoints, place)) {
      if (words.front() == "check" || words.front() == "motion") continue;  // no output; no points
      expect_failure(folder(), words, 1, place);
    }
    for (const Words& words : {Words{"mesh", "make", "plate", "-o", place / "plate.glb"},
                               {"mesh", "info", folder() / "whole.glb", "--picture", place / "mesh.png"},
                               rcs({"-o", place / "x.csv"})})
      expect_failure(folder(), words, 1, place);
  }
}

// Command-line arguments: numbers, misspelt words, options that belong to other commands.

class Options : public testing::Test {
 protected:
  void expect_refused(const Words& words, const Words& more, const std::string& message) const {
    SCOPED_TRACE(testing::PrintToString(words));
    seaglint::expect_refused(run_program(words, more), message);
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
  completed(rcs(), {"--max-bounces", "010", "--wavefront-range-m", "0100"});
  EXPECT_THAT(read_file(folder_.path() / "rcs.csv"),
              testing::AllOf(HasSubstr("max_bounces 10,"), HasSubstr("wavefront_range_m 100 ")));
  completed({"mesh", "make", "cylinder", "--segments", "+012", "-o", folder_.path() / "c.stl"});
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
  expect_refused({"map", kPoints, "-o", folder_.path() / "m.png"}, {"--sample", "0x1"},
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
  expect_refused({"check", kPoints, "--sets", "x=1"}, {},
                 "unknown option '--sets': did you mean '--set'? (see seaglint check --help)\n");
  expect_refused({"check", "--nothing-like-it"}, {},
                 "unknown option '--nothing-like-it' (see seaglint check --help)\n");
  expect_refused({"mesh", "make", "foo"}, {}, "unknown command 'foo': must be one of ship, ");
  expect_refused({"mesh", "make", "plte", "--length-m", "2"}, {},
                 "unknown command 'plte': did you mean 'plate'? (see seaglint mesh make --help)\n");
  expect_refused({"mesh", "mkae"}, {}, "unknown command 'mkae': did you mean 'make'? (see seaglint mesh --help)\n");
  expect_refused({"mesh", "make"}, {}, "A subcommand is required (see seaglint mesh make --help)\n");
  expect_refused({"check", kPoints, "other.yaml"}, {}, "other.yaml");
}

TEST_F(Options, ThatNeedOthersNameThem) {
  const Words sea{"sea", kPoints, "-o", folder_.path() / "sea.csv"};
  expect_refused(sea, {"--realisations", "2"},
                 "--realisations requires --spectrum or --figure (see seaglint sea --help)\n");
  expect_refused(rcs(), {"--transmit-elevation-deg", "2"},
                 "--transmit-elevation-deg requires --transmit-azimuth-deg (see seaglint rcs --help)\n");
}

// Names in a user's files are commands to nothing: not to the terminal, a spreadsheet, a Markdown page or gnuplot.

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
  completed({"rcs", "--target", mesh, "--frequency-ghz", "1", "--azimuth-deg", "0", "--elevation-deg", "0",
             "--export-scattering-centres", centres, "-o", folder.path() / "rcs.csv"});
  EXPECT_HAS(read_file(centres), ",\"'=cmd|calc,\"\"x\",1,");
}

TEST(HostileNames, NeverReachTheTerminalAsBytes) {
  const TemporaryFolder folder;
  const fs::path mesh = folder.path() / "plate.obj", scenario = folder.path() / "s.yaml";
  write_file(mesh, plate_of("\x1b]0;title\x07\xff"));
  const ProgramResult info = completed({"mesh", "info", mesh});
  EXPECT_HAS(info.out, "\\x1b]0;title\\x07");
  EXPECT_FALSE(has_control_characters(info.out));
  write_file(scenario, "seaglint: 1\nname: \"a\\e[31m\"\n");
  const ProgramResult refused = run_program({"check", scenario});
  EXPECT_EQ(refused.code, 2);
  EXPECT_HAS(refused.err, "\\x1b[31m");
  EXPECT_FALSE(has_control_characters(refused.err));
}

TEST(HostileNames, AreEscapedInDataCards) {
  const TemporaryFolder folder;
  const fs::path data = folder.path() / "data";
  completed({"generate", kPoints, "--set", "dataset.maps_per_case=2", "--set", "dataset.realisations_per_case=1",
             "--set", "name=a` <script>alert(1)</script> |", "-o", data});
  EXPECT_THAT(read_file(data / "README.md"), testing::StartsWith("# Data set `` a` <script>alert(1)</script> | ``\n"));
}

}  // namespace
}  // namespace seaglint

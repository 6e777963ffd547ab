// SPDX-License-Identifier: BSD-3-Clause
// For every wrong input each command reports one line, exits with the documented code and leaves no file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

using Words = std::vector<std::string>;

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
  EXPECT_THAT(result.err, HasSubstr(message));
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

 private:
  TemporaryFolder folder_;
};

TEST_F(InputErrors, OfATypoInAKey) {
  const std::string file = scenario("sea: {peek_period_s: 8}\n");
  for (const Words& words : scenario_commands(file, folder()))
    expect_failure(folder(), words, 2,
                   "scenario.yaml:2:7: sea.peek_period_s: unknown key: did you mean 'peak_period_s'?\n");
}

TEST_F(InputErrors, OfANegativeWaveHeight) {
  const std::string file = scenario("sea: {significant_wave_height_m: -1}\n");
  for (const Words& words : scenario_commands(file, folder()))
    expect_failure(folder(), words, 2,
                   "scenario.yaml:2:34: sea.significant_wave_height_m: value '-1': must be a number");
}

// The sea contains no targets: `sea` reads no mesh.
TEST_F(InputErrors, OfAMeshThatIsMissingOrCutShort) {
  for (const std::string mesh : {"none.glb", "truncated.glb"}) {
    const std::string file = scenario("", mesh);
    for (const Words& words : scenario_commands(file, folder())) {
      if (words.front() != "sea") expect_failure(folder(), words, 2, mesh);
    }
    const std::string path = folder() / mesh;
    expect_failure(folder(), {"mesh", "info", path, "--picture", folder() / "mesh.png"}, 2, mesh + ": ");
    expect_failure(folder(),
                   {"rcs", "--target", path, "--frequency-ghz", "10", "--azimuth-deg", "0", "-o", folder() / "rcs.csv"},
                   2, mesh + ": ");
  }
}

// The 144 m ship extends 72 m from its origin; the second order of the wavefront needs ten times that range.
TEST_F(InputErrors, OfAWavefrontRangeTooShort) {
  for (const char* command : {"check", "generate"}) {
    Words words{command, "scenarios/quick.yaml", "--set", "targets.ship.solver.wavefront_range_m=500"};
    if (words.front() != "check") words.insert(words.end(), {"-o", folder() / "data"});
    expect_failure(folder(), words, 2, "targets.ship.solver: wavefront range 500 m");
  }
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
  for (const Words& more : {Words{}, Words{"--set", "targets.array.solver.wavefront_range_m=600"}}) {
    for (Words words : {Words{"check", file}, Words{"map", file, "-o", folder() / "map.png"},
                        Words{"generate", file, "-o", folder() / "data"}}) {
      words.insert(words.end(), more.begin(), more.end());
      expect_failure(
          folder(), words, 2,
          more.empty()
              ? "near.yaml:3:72: targets.ship.companions.0: wavefront range 400 m: must be at least ten "
                "times the target radius of 60.5 m"
              : "targets.array.solver: wavefront range 600 m: must be at least ten times the target radius of 60.5 m");
    }
  }
  const ProgramResult far = run_program({"check", file, "--set", "targets.ship.solver.wavefront_range_m=610", "--set",
                                         "targets.decoy.solver.wavefront_range_m=610", "--set",
                                         "targets.array.solver.wavefront_range_m=610"});
  EXPECT_EQ(far.code, 0) << far.err;
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
    for (Words words : {Words{"check", file}, Words{"map", file, "-o", folder() / "map.png"},
                        Words{"generate", file, "-o", folder() / "data"}}) {
      words.insert(words.end(), {"--set", std::string("targets.ship.motion.series_start_s=") + start});
      expect_failure(folder(), words, 2, "targets.ship.motion.series_start_s: value ");
    }
  }
  EXPECT_EQ(run_program({"check", file}).code, 0);
}

TEST_F(InputErrors, OfATargetUnderWater) {
  const std::string file = folder() / "water.yaml";
  write_file(
      file,
      "seaglint: 1\nsea_reflection: {enabled: true}\ntargets:\n"
      "  array: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float, origin_above_waterline_m: "
      "-10}}\n");
  for (const char* reflects : {"true", "false"}) {
    for (Words words : {Words{"check", file}, Words{"map", file, "-o", folder() / "map.png"},
                        Words{"generate", file, "-o", folder() / "data"}}) {
      words.insert(words.end(), {"--set", std::string("sea_reflection.enabled=") + reflects});
      expect_failure(
          folder(), words, 2,
          "water.yaml:4:110: targets.array.motion.origin_above_waterline_m: value -10: must be greater than ");
    }
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
  EXPECT_THAT(result.err, HasSubstr("\nseaglint: " + file + ":5:10: targets.plate: sample "));
  EXPECT_THAT(result.err, HasSubstr("has no power"));
  EXPECT_TRUE(files_below(folder()) == before);
}

TEST_F(InputErrors, OfANumberThatIsNotANumber) {
  const std::string mesh = folder() / "whole.glb";
  for (const char* option : {"--wavefront-range-m", "--min-patch-m", "--transmit-azimuth-deg", "--centre-cell-m"}) {
    expect_failure(folder(),
                   {"rcs", "--target", mesh, "--frequency-ghz", "10", "--azimuth-deg", "0", "-o", folder() / "rcs.csv",
                    option, "nan"},
                   2, std::string(option) + ": value nan: must be within");
  }
  for (const char* angle : {"nan", "61", "-1", "smooth"})
    expect_failure(folder(),
                   {"rcs", "--target", mesh, "--frequency-ghz", "10", "--azimuth-deg", "0", "-o", folder() / "rcs.csv",
                    "--crease-deg", angle},
                   2, std::string("value ") + angle + ": must be auto or within 0 and 60");
  expect_failure(folder(), {"mesh", "info", mesh, "--min-wedge-angle-deg", "nan"}, 2, "value nan");
  expect_failure(folder(), {"map", "scenarios/points.yaml", "--sample", "-1", "-o", folder() / "map.png"}, 2, "-1");
}

// Bounds and references to help are those of the command that was called.
TEST_F(InputErrors, OfAnOptionWithItsBoundsAndHelp) {
  for (const char* value : {"-1", "2.5", "1e3", "99999999999999999999"}) {
    for (const Words& words :
         {Words{"map", "scenarios/points.yaml", "-o", folder() / "map.png"},
          Words{"echo", "scenarios/points.yaml", "-o", folder() / "e.npz"}, Words{"regenerate", folder()}}) {
      Words all = words;
      all.insert(all.end(), {"--sample", value});
      expect_failure(folder(), all, 2,
                     std::string("--sample: value ") + value + ": must be a whole number, 0 or more (see seaglint " +
                         words[0] + " --help)\n");
    }
  }
  expect_failure(folder(), {"mesh", "make", "sphere", "--diameter-m", "1"}, 2,
                 "(see seaglint mesh make sphere --help)\n");
  expect_failure(folder(), {"mesh", "info"}, 2, "(see seaglint mesh info --help)\n");
  expect_failure(folder(), {"verify", std::string(300, 'x')}, 1, "xxx/manifest.json: File name too long\n");
}

// Names of parts and values of files that a terminal would obey are shown, not sent.
TEST_F(InputErrors, AndFindingsSendNoByteOfAFileToTheTerminal) {
  write_file(folder() / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng x\x1b[31m\nf 1 2 3\n");
  const ProgramResult info = run_program({"mesh", "info", folder() / "a.obj"});
  EXPECT_EQ(info.code, 0);
  EXPECT_THAT(info.out, HasSubstr("x\\x1b[31m"));
  EXPECT_EQ(info.out.find('\x1b'), std::string::npos);
  write_file(folder() / "b.obj", "v \x1b[2J\xc2\x9b 0 0\n");
  const ProgramResult refused = run_program({"mesh", "info", folder() / "b.obj"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("b.obj:1: \"\\x1b[2J\\xc2\\x9b\" is not a coordinate"));
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
    expect_failure(folder(), {command, "scenarios/points.yaml", "-o", folder() / "other", "--resume"}, 2,
                   "other: the directory contains");
}

// An output must not overwrite an input, by whatever name and key the input is given.
TEST_F(InputErrors, OfWritingOverAnInput) {
  const std::string mesh = folder() / "whole.glb", file = scenario(""), rao = folder() / "rao.csv",
                    link = folder() / "link.glb";
  write_file(rao, "none");
  fs::create_symlink(mesh, link);
  const Words rcs{"rcs", "--target", mesh, "--frequency-ghz", "10", "--azimuth-deg", "0"};
  const auto with = [](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  for (const Words& words :
       {with(rcs, {"-o", mesh}), with(rcs, {"-o", link}), with(rcs, {"-o", rao, "--reference", rao}),
        with(rcs, {"-o", folder() / "rcs.csv", "--export-scattering-centres", folder() / "." / "whole.glb"}),
        Words{"mesh", "info", mesh, "--picture", mesh}, Words{"sea", file, "-o", file},
        Words{"motion", file, "-o", file}, Words{"motion", file, "-o", mesh},
        Words{"motion", file, "-o", rao, "--rao", folder() / "rao.png", "--rao-reference", rao}}) {
    expect_failure(folder(), words, 2, "is read here, and would be written over");
  }
}

TEST_F(InputErrors, OfTwoOutputsInOneFile) {
  const std::string mesh = folder() / "whole.glb", file = scenario(""), csv = folder() / "out.csv",
                    png = folder() / "out.png";
  for (const Words& words : {Words{"sea", file, "-o", csv, "--spectrum", csv, "--realisations", "2"},
                             Words{"motion", file, "-o", csv, "--spectrum", folder() / "." / "out.csv"},
                             Words{"motion", file, "-o", csv, "--figure", png, "--snapshots", png},
                             Words{"rcs", "--target", mesh, "--frequency-ghz", "10", "--azimuth-deg", "0", "-o", csv,
                                   "--export-scattering-centres", csv}}) {
    expect_failure(folder(), words, 2, "would be written twice");
  }
}

TEST_F(InputErrors, OfAnEndingOfAnotherFormat) {
  const std::string mesh = folder() / "whole.glb";
  expect_failure(folder(), {"echo", "scenarios/points.yaml", "-o", folder() / "echo.csv"}, 2,
                 "echo.csv: NumPy's archives end in .npz");
  for (const char* name : {"ship.jpg", "ship.svg", "ship"})
    expect_failure(folder(), {"mesh", "info", mesh, "--picture", folder() / name}, 2,
                   std::string(name) + ": the name of a mesh's picture ends in .png");
  expect_failure(folder(), {"regenerate", folder(), "--sample", "0", "-o", folder() / "sample"}, 2,
                 "sample: NumPy's archives end in .npz");
  expect_failure(folder(),
                 {"rcs", "--target", mesh, "--frequency-ghz", "10", "--azimuth-deg", "0", "-o", folder() / "rcs.csv",
                  "--export-hot-spots", folder() / "spots.obj"},
                 2, "spots.obj: colours need the ending .glb or .gltf");
}

// The shell's limit is in units of 1024 bytes; by default the system kills a program that exceeds it.
TEST_F(InputErrors, OfALimitOnFileSizes) {
  const auto limited = [&](const Words& words) {
    SCOPED_TRACE(words.front());
    Words all{"/bin/bash", "-c", "ulimit -f 20; exec \"$@\"", "limited", kProgram};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult result = run_words(all);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err, testing::AllOf(HasSubstr("cannot write"), HasSubstr("File too large")));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  const auto before = files_below(folder());
  limited({"mesh", "make", "sphere", "-o", folder() / "sphere.obj"});
  EXPECT_TRUE(files_below(folder()) == before);
  limited({"generate", "scenarios/points.yaml", "-o", folder() / "data"});
  Words names;
  for (const auto& entry : fs::directory_iterator(folder() / "data")) names.push_back(entry.path().filename());
  EXPECT_THAT(names, testing::ElementsAre("scenario.yaml"));
}

// Below a file and in /proc no user can write, not even root; a folder without write permission stops all other users.
TEST_F(InputErrors, OfAPlaceThatCannotBeWritten) {
  const fs::path locked = folder() / "locked";
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
  std::vector<fs::path> places{folder() / "whole.glb", "/proc"};
  if (::geteuid() != 0) places.push_back(locked);
  for (const fs::path& place : places) {
    for (const Words& words : scenario_commands("scenarios/points.yaml", place)) {
      if (words.front() == "check" || words.front() == "motion") continue;  // no output; no points
      expect_failure(folder(), words, 1, place);
    }
    const std::string mesh = folder() / "whole.glb";
    expect_failure(folder(), {"mesh", "make", "plate", "-o", place / "plate.glb"}, 1, place);
    expect_failure(folder(), {"mesh", "info", mesh, "--picture", place / "mesh.png"}, 1, place);
    expect_failure(folder(),
                   {"rcs", "--target", mesh, "--frequency-ghz", "10", "--azimuth-deg", "0", "-o", place / "x.csv"}, 1,
                   place);
  }
}

}  // namespace
}  // namespace seaglint

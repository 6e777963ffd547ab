// SPDX-License-Identifier: BSD-3-Clause
// Wrong input gives one clear line and exit code 2, for `check` as for every command that reads a scenario.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/scenario.h"
#include "tests/pipeline/program.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Refused with nothing but one line.
void expect_one_line(const Words& arguments, const std::string& sentence) {
  SCOPED_TRACE(testing::PrintToString(arguments));
  const ProgramResult result = run_program(arguments);
  expect_refused(result, sentence);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST(Check, PrintsAScenarioThatReadsBackTheSame) {
  const ProgramResult result = completed({"check", kPoints, "--set", "radar.pulses=64"});
  EXPECT_THAT(result.err, StartsWith("points: 2 targets, 1 sea states x 2 views = 2 cases, 40 maps\n"));
  EXPECT_HAS(result.err, "\nrange resolution    0.7495 m,");
  EXPECT_EQ(effective_yaml(parse_scenario(result.out, kPoints)), result.out);
  EXPECT_EQ(parse_scenario(result.out, kPoints).radar.pulses, 64);
}

TEST(Check, SaysHowMuchThereIsWhatVariesAndWhatMoves) {
  const std::string said = run_program({"check", kPoints, "--set", "sea.peak_period_s=uniform(7, 9)"}).err;
  EXPECT_HAS(said,
             "\nseas                5: 5 realisations of each sea state, 2 intervals of each 10 s apart "
             "and view\nswept               view.azimuth_deg 30, 80\n"
             "drawn               sea.peak_period_s uniform(7, 9), once per sea\n"
             "moves               line: 8 points with velocities of their own in any sea\n");
  EXPECT_THAT(said, ContainsRegex("\nwork +about [0-9.]+ [a-z]+ of processor, [0-9.]+ [a-z]+ on [0-9]+ threads?, "
                                  "[0-9.]+ [kM]B of maps\n"));
}

// Maps of ideal points at Hs 0.1 and 3 m are equal to the last bit.
TEST(Check, NamesAKeyThatChangesNothingAsGenerateDoes) {
  const TemporaryFolder folder;
  const std::string said =
      "seaglint: warning: sea.significant_wave_height_m (0.1, 3) changes nothing: maps that differ in it alone are "
      "equal: targets.line is of points, which do not follow the sea; ";
  const Words seas{"--set", "sea.significant_wave_height_m=[0.1, 3]", "--set",
                   "dataset={maps_per_case: 2, realisations_per_case: 2}"};
  for (const Words& words : {Words{"check", kPoints}, {"generate", kPoints, "-o", folder.path() / "data"}})
    EXPECT_HAS(completed(words, seas).err, said) << words[0];
  EXPECT_THAT(run_program({"check", kPoints}).err, Not(HasSubstr("changes nothing")));
}

TEST(Check, SaysWhatCarriesAndHoldsFloats) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "line.yaml";
  write_file(
      file,
      "seaglint: 1\nradar: {pulses: 16}\nsea: {components: 64}\ntargets: {line: {label: 0, decoy: {kind: octahedral}, "
      "layout: {line: {count: 4, spacing_m: 40}, tether_slack: 0.05, jitter_m: 1}, motion: {model: float, "
      "translations: true, drift: {wind_mps: 10, wind_towards_deg: 90, current_mps: 0.4}}}}\n"
      "dataset: {maps_per_case: 1, realisations_per_case: 1}\n");
  EXPECT_THAT(
      completed({"check", file}).err,
      ContainsRegex("\nmoves +line: float, roll .* at Hs 1 m; without its ropes of 42 m, which hold surge and sway; "
                    "drifts at 0.5 m/s towards 36.9 deg; yaw is 0 without"));
  EXPECT_HAS(completed({"check", file, "--set", "targets.line.motion.drift.spread_mps=0.1", "--set",
                        "targets.line.layout={line: {count: 4}}", "--set", "sea.significant_wave_height_m=0"})
                 .err,
             "; drifts at 0.5 m/s towards 36.9 deg, each by itself at 0.1 m/s rms\n");
}

TEST(Check, NamesDegreesOfFreedomAtRestAsMotionAndGenerateDo) {
  const TemporaryFolder folder;
  write_file(folder.path() / "box.obj",
             "v -15 -4 0\nv 15 -4 0\nv 15 4 0\nv -15 4 0\nv -15 -4 4\nv 15 -4 4\nv 15 4 4\nv -15 4 4\n"
             "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const std::string file = folder.path() / "box.yaml";
  write_file(file,
             "seaglint: 1\nradar: {pulses: 16}\ntargets: {box: {label: 1, mesh: box.obj, motion: {model: ship}}}\n"
             "dataset: {maps_per_case: 1, realisations_per_case: 1}\n");
  const std::string said = "surge, sway, heave are 0 without targets.box.motion.translations: true\n";
  EXPECT_HAS(run_program({"check", file}).err, said);
  for (const Words& words :
       {Words{"motion", file, "-o", folder.path() / "motion.csv"}, {"generate", file, "-o", folder.path() / "data"}})
    EXPECT_HAS(run_program(words).err, "targets.box: " + said) << words[0];
  EXPECT_THAT(run_program({"check", file, "--set", "targets.box.motion.translations=true"}).err,
              Not(HasSubstr(" are 0 ")));
}

// The warnings that rcs prints about a mesh are printed for a scenario too, once per target.
TEST(Check, WarnsAboutMeshes) {
  const TemporaryFolder folder;
  TriangleMesh inside_out = make_icosahedral_reflector();
  for (auto& t : inside_out.triangles) std::swap(t[1], t[2]);
  write_mesh(folder.path() / "inside_out.obj", inside_out);
  TriangleMesh holed = make_sphere(0.01, 2);  // below three wavelengths at the radar's lowest frequency
  holed.triangles.pop_back();
  write_mesh(folder.path() / "holed.obj", holed);
  const std::string file = folder.path() / "doubtful.yaml";
  write_file(
      file,
      "seaglint: 1\nview: {azimuth_deg: 10}\nsea: {significant_wave_height_m: 1}\n"
      "targets:\n  a: {label: 1, mesh: inside_out.obj, offset_m: [0, 0, 0.6], companions: [{target: b, x_m: 10}]}\n"
      "  b: {label: 0, mesh: holed.obj, offset_m: [0, 0, 0.1]}\n");
  const std::string said =
      "seaglint: warning: targets.a.mesh: 1 closed surface is inside out (60 triangles): turned outwards\n"
      "seaglint: warning: targets.b.mesh: 3 open edges; 1 of 1 surfaces are open: holes, or sheets, seen from both "
      "sides and through their holes\n"
      "seaglint: warning: targets.b.mesh: the target is 0.0346 m across, 1.85 wavelengths at 15.9875 GHz; physical "
      "optics needs 3 and more\n";
  EXPECT_HAS(completed({"check", file}).err, said);
  EXPECT_THAT(run_program({"map", file, "--sample", "0", "-o", folder.path() / "map.png"}).err, StartsWith(said));
}

// So do the commands that make maps.
TEST(Check, PrintsTheConventionsOfAResponseFile) {
  const TemporaryFolder folder;
  write_mesh(folder.path() / "plate.obj", make_plate(1, 1));
  const std::string file = folder.path() / "response.yaml", table = "tests/reference/ship_motion/fpso.4";
  write_file(file,
             "seaglint: 1\nview: {azimuth_deg: 10}\nsea: {significant_wave_height_m: 1}\n"
             "dataset: {maps_per_case: 1, realisations_per_case: 1}\n"
             "targets:\n  a: {label: 1, mesh: plate.obj, motion: {model: rao, file: " +
                 table + "}}\n");
  const std::string said =
      "targets.a.motion.file: " + table +
      ": 12 headings of waves towards -150 to 180 deg (WAMIT: the direction of propagation), 29 frequencies 0.03834 to "
      "5.712 rad/s, speed 0 m/s, time factor e^{+iwt}; its longest waves, 163.9 s, confirm heave, pitch, roll\n";
  EXPECT_HAS(run_program({"check", file}).err, said);
  EXPECT_HAS(completed({"generate", file, "-o", folder.path() / "data"}).err, said);
  const std::string csv = folder.path() / "motion.csv";
  EXPECT_HAS(run_program({"motion", file, "--duration-s", "1", "-o", csv}).err, said);
  expect_one_line({"check", file, "--set", "targets.a.motion.wamit_heading=from"},
                  "motion.wamit_heading (now from) or motion.wamit_time_factor (now plus) is not the file's");
}

// Eight components give a different sea in every realisation; the default 512 do not.
TEST(Check, WarnsOfTooFewComponents) {
  const std::string said =
      "seaglint: warning: sea.components: 8 components at Tp 8 s give strata 1.2 of the peak frequency wide, so that "
      "the mean period varies between realisations; 98 or more keep it within about 1 %\n";
  EXPECT_HAS(run_program({"check", kPoints, "--set", "sea.components=8"}).err, said);
  const TemporaryFolder folder;
  EXPECT_HAS(
      run_program({"sea", kPoints, "--duration-s", "1", "-o", folder.path() / "sea.csv", "--set", "sea.components=8"})
          .err,
      said);
  EXPECT_THAT(run_program({"check", kPoints, "--set", "sea.components=98"}).err, Not(HasSubstr("sea.components")));
  EXPECT_HAS(run_program({"check", kPoints, "--set", "sea.swell={significant_wave_height_m: 1, components: 9}"}).err,
             "sea.swell.components: 9 components at Tp 12 s give strata 0.4 of the peak frequency wide");
}

TEST(Check, RefusesMeshesThatScatterNothing) {
  const TemporaryFolder folder;
  write_file(folder.path() / "line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  write_file(folder.path() / "far.obj", "v 9000 0 0\nv 9000 1 0\nv 9000 0 1\nf 1 2 3\n");
  const std::string file = folder.path() / "bad.yaml";
  const auto refused = [&](const std::string& mesh, const std::string& message) {
    write_file(file, "seaglint: 1\ntargets:\n  a: {label: 1, mesh: " + mesh + ", motion: {model: fixed}}\n");
    expect_one_line({"check", file}, "bad.yaml:3:23: targets.a.mesh: " + message);
  };
  refused("line.obj", "no triangle has an area: nothing scatters");
  refused("far.obj", "the target of 1.414 m is centred 9000 m from the origin");
}

TEST(Keys, AreListedWithDefaultAndBound) {
  const ProgramResult result = completed({"keys"});
  EXPECT_THAT(result.out, ContainsRegex("\nradar.carrier_ghz +16 +within 0.1 and 300 GHz\n"));
  EXPECT_THAT(result.out, ContainsRegex("\ntargets.NAME.label +required +whole, within 0 and 9\n"));
  EXPECT_THAT(
      result.out,
      ContainsRegex("\ntargets.NAME.points.N.position_m +required +\\[x, y, z\\], within -100000 and 100000 m\n"));
  EXPECT_THAT(
      result.out,
      ContainsRegex("\nsea.peak_period_s +8 +number, list or from:to:step, within 0.5 and 40 s, or dnv_wind_sea or "
                    "wind_and_fetch\n"));
}

TEST(Keys, OfASectionComeWithTheirMeanings) {
  const ProgramResult section = completed({"keys", "sea.spreading"});
  EXPECT_THAT(section.out, StartsWith("sea.spreading.kind "));
  EXPECT_HAS(section.out, "    Standard deviation of wrapped_normal.\n");
  EXPECT_THAT(section.out, Not(HasSubstr("sea.swell")));
  EXPECT_THAT(run_program({"keys", "targets.ship.points.3.amplitude_m"}).out,
              StartsWith("targets.NAME.points.N.amplitude_m "));
  expect_one_line({"keys", "sea.gama"},
                  "sea.gama: unknown key or section, and in no key's meaning: did you mean 'sea.gamma'?\n");
  expect_one_line({"keys", "weather"},
                  "weather: unknown key or section, and in no key's meaning: `seaglint keys` lists all");
  expect_one_line({"keys", "sea", "--json"}, "--json lists all keys");
  expect_one_line({"keys", "sea", "--schema"}, "--schema lists all keys");
}

TEST(Keys, AsJsonHaveAMeaningEach) {
  const ProgramResult result = completed({"keys", "--json"});
  const auto list = nlohmann::json::parse(result.out);
  EXPECT_GT(list.size(), 150u);
  for (const auto& entry : list) EXPECT_GE(entry.at("meaning").get<std::string>().size(), 10u) << entry;
}

TEST(Keys, AsASchemaAreThatOfTheShippedScenarios) {
  EXPECT_EQ(run_program({"keys", "--schema"}).out, read_file(SEAGLINT_SOURCE_DIR "/scenarios/schema.json"));
}

TEST(Init, WritesAScenarioThatWorksAndReplacesNone) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "study.yaml", name = folder.path() / "study";
  const ProgramResult made = run_program({"init", name});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_HAS(made.out, "seaglint run " + file + " -o " + name + "\n");
  const std::string text = read_file(file);
  EXPECT_THAT(text, StartsWith("# yaml-language-server: $schema=/"));
  EXPECT_HAS(text, "\n  # Lowest carrier. [within 0.1 and 300 GHz]\n  carrier_ghz: 16\n");
  EXPECT_HAS(text, "\n  peak_period_s: uniform(7, 9)\n");
  const ProgramResult check = run_program({"check", file});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(check.err, Not(HasSubstr("warning")));
  expect_refused({"init", name}, "study.yaml: is there already; choose another name\n");
  EXPECT_EQ(read_file(file), text);
}

TEST(Check, RefusesATargetWhoseEchoOutlastsThePulse) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "far.yaml";
  write_file(file, "seaglint: 1\ntargets:\n  far: {label: 1, points: [{position_m: [20000, 0, 0], amplitude_m: 1}]}\n");
  expect_one_line({"check", file},
                  "far.yaml:3:3: targets: a target reaches 20000 m from the reference point: its echo lasts");
}

// One run names them all; exit code 2.
TEST(Check, RefusesAllMistakesOfAScenarioInOneRunALineEach) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "wrong.yaml";
  write_file(
      file, "seaglint: 1\nradar:\n  bandwidth: 25\n  pulses: many\ntargets: {a: {label: 1, mesh: a.glb, scale: -1}}\n");
  const ProgramResult result = run_program({"check", file, "--set", "seed=x"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err,
            "seaglint: " + file + ":3:3: radar.bandwidth: unknown key: did you mean 'bandwidth_mhz'?\n" + "seaglint: " +
                file + ":4:11: radar.pulses: value 'many': must be a whole number within 1 and 1048576\n" +
                "seaglint: " + file + ":5:45: targets.a.scale: value '-1': must be a number within 0.001 and 1000\n" +
                "seaglint: --set seed: value 'x': must be a whole number within 0 and 9223372036854775807\n");
}

TEST(Check, RefusesAllMissingFilesWithTheNamesThatTheyMean) {
  const TemporaryFolder folder;
  write_mesh(folder.path() / "hull.obj", make_sphere(1, 2));
  const std::string file = folder.path() / "files.yaml";
  write_file(file,
             "seaglint: 1\ntargets:\n  a: {label: 1, mesh: hul.obj, material: aluminum}\n  b: {label: 0, mesh: "
             "combatant_144.glb}\n");
  const ProgramResult result = run_program({"check", file});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 3) << result.err;
  for (const std::string& part :
       {"files.yaml:3:23: targets.a.mesh: value 'hul.obj': no such file, neither in " + folder.path().string() +
            " nor in the working directory nor in ",
        std::string(": did you mean 'hull.obj'?\n"),
        std::string("targets.a.material: value 'aluminum': no such material"),
        std::string("did you mean 'aluminium'?\n"), std::string(": did you mean 'assets/combatant_144m.glb'?\n")})
    EXPECT_HAS(result.err, part);
  expect_one_line({"check", kPoints, "--set", "sea.significant_wave_height_m=-1"},
                  "--set sea.significant_wave_height_m: value '-1': must be a number, a list or from:to:step, 0 or "
                  "within 1e-06 and 30, or from_table\n");
}

TEST(Check, RefusesScenariosThatCannotBeRead) {
  const TemporaryFolder folder;
  expect_one_line({"check", folder.path() / "none.yaml"}, "none.yaml: cannot read: No such file or directory\n");
  expect_one_line({"check", folder.path()}, ": cannot read: is a directory\n");
  write_file(folder.path() / "empty.yaml", "");
  expect_one_line({"check", folder.path() / "empty.yaml"}, "empty.yaml: the file is empty");
  const std::vector<char> blanks(100'000'000, ' ');
  write_file(folder.path() / "large.yaml", {blanks.data(), blanks.size()});
  expect_one_line({"check", folder.path() / "large.yaml"},
                  "large.yaml: cannot read: has 100000000 bytes, more than the limit of 4000000\n");
}

TEST(CommandLine, RefusesUnknownWords) {
  expect_one_line({}, "A subcommand is required (see seaglint --help)\n");
  expect_one_line({"chek", kPoints}, "unknown command 'chek': did you mean 'check'? (see seaglint --help)\n");
  expect_one_line({"check"}, "SCENARIO is required (see seaglint check --help)\n");
  expect_one_line({"check", kPoints, "--bogus"}, "unknown option '--bogus' (see seaglint check --help)\n");
  expect_one_line({"check", kPoints, "--set", "radar.pulses"}, "--set radar.pulses: must be key.path=value\n");
  expect_one_line({"--bogus"}, "(see seaglint --help)\n");
}

TEST(CommandLine, FailsWhenItsOutputCannotBeWritten) {
  const std::string command =
      "'" SEAGLINT_BINARY_DIR "/seaglint' check '" SEAGLINT_SOURCE_DIR "/scenarios/points.yaml' >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
}

// Output that cannot be printed is not a failure, and no file is opened under the number of a closed stream.
TEST(CommandLine, ClosedOrFullStandardErrorChangesNoExitCode) {
  const TemporaryFolder folder;
  const std::string csv = folder.path() / "cut.csv",
                    rcs = "rcs --target assets/icosahedral_reflector.glb --frequency-ghz 10 --azimuth-deg 0 -o '" +
                          csv + "'";
  const auto code = [](const std::string& arguments) {
    return run_words({"/bin/bash", "-c", "exec \"$0\" " + arguments, kProgram}).code;
  };
  for (const std::string quiet : {" 2>&-", " 2>/dev/full", " <&- 2>&-"}) {
    EXPECT_EQ(code("check scenarios/points.yaml" + quiet), 0) << quiet;
    EXPECT_EQ(code("check none.yaml" + quiet), 2) << quiet;
    EXPECT_EQ(code("check scenarios/points.yaml --set map.range_span_m=20" + quiet), 0) << "a warning" << quiet;
    EXPECT_EQ(code("check scenarios/points.yaml >/dev/full" + quiet), 1) << quiet;
    EXPECT_EQ(code("check scenarios/points.yaml >&-" + quiet), 1) << quiet;
    ASSERT_EQ(code(rcs), 0);
    const std::string whole = read_file(csv);
    EXPECT_EQ(code(fmt::format("{} >/dev/null{}", rcs, quiet)), 0) << quiet;
    EXPECT_EQ(read_file(csv), whole) << quiet;
  }
}

TEST(CommandLine, ReportsErrorsOnOneLine) {
  const ProgramResult result = run_program({"check", kPoints, "--set", "seed=1\nview: 3"});
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err, "seaglint: --set seed: value '1\\nview: 3': not valid YAML\n");
}

// Each line of the list of commands in --help starts with a command's name.
std::vector<std::string> command_names() {
  std::istringstream help(run_program({"--help"}).out);
  std::vector<std::string> names;
  bool listing = false;
  for (std::string line; std::getline(help, line);) {
    if (listing && line.empty()) break;
    if (listing && line.starts_with("  ") && line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
    if (line == "Subcommands:") listing = true;
  }
  return names;
}

TEST(CommandLine, EveryCommandHasHelpWithAnExample) {
  const std::vector<std::string> names = command_names();
  EXPECT_THAT(names, ::testing::Contains("check"));
  for (const std::string& name : names)
    EXPECT_HAS(completed({name, "--help"}).out, "Example:\n  seaglint " + name) << name;
  EXPECT_THAT(run_program({"--version"}).out, ::testing::MatchesRegex("seaglint [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

}  // namespace
}  // namespace seaglint

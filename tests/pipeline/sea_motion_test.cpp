// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <sstream>

#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/realisation.h"
#include "sim/sea/wave_field.h"
#include "tests/pipeline/program.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

// `sea` and `motion` write the results of their stages in the documented columns.

// The lines of a CSV file below its comments; the first is the header.
std::vector<std::string> data_lines(const std::filesystem::path& file) {
  std::istringstream text(read_file(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
    if (line.empty() || line[0] != '#') lines.push_back(line);
  return lines;
}

std::vector<double> numbers(const std::string& line) {
  std::istringstream cells(line);
  std::vector<double> values;
  for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::strtod(cell.c_str(), nullptr));
  return values;
}

// A scenario with a box for a ship and boxes for floats next to it.
std::string write_boxes(const std::filesystem::path& folder) {
  write_file(folder / "box.obj",
             "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
             "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  write_file(folder / "boxes.yaml",
             "seaglint: 1\nname: boxes\nsea: {significant_wave_height_m: [1, 2]}\ntargets:\n"
             "  ship: {label: 1, mesh: box.obj, motion: {model: ship, length_m: 142, beam_m: 19}}\n"
             "  array: {label: 0, mesh: box.obj, layout: {line: {count: 2, spacing_m: 40}}, motion: {model: float}}\n");
  return folder / "boxes.yaml";
}

TEST(Sea, WritesTheSurfaceOfTheFirstSeaState) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "sea.csv";
  completed({"sea", kPoints, "--at", "-5,3", "--duration-s", "20", "--step-s", "0.5", "-o", file, "--set",
             "sea.propagation_deg=30"});
  const std::vector<std::string> lines = data_lines(file);
  ASSERT_EQ(lines.size(), 42u);
  EXPECT_EQ(lines[0], "time_s,elevation_m,elevation_linear_m,slope_x,slope_y");
  const Scenario scenario = read_scenario(SEAGLINT_SOURCE_DIR "/" + kPoints, {{"sea.propagation_deg", "30"}});
  const WaveField field = realise_sea(sea_states(scenario.sea).front(), scenario.seed, sea_key(0, 0));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<double> row = numbers(lines[i]);
    ASSERT_EQ(row.size(), 5u);
    const SurfaceState surface = field.surface(-5, 3, row[0]);
    // Nine digits are printed.
    EXPECT_NEAR(row[1], surface.elevation, 1e-8);
    EXPECT_NEAR(row[2], surface.elevation_linear, 1e-8);
    EXPECT_NEAR(row[3], surface.slope_x, 1e-9);
    EXPECT_NEAR(row[4], surface.slope_y, 1e-9);
  }
  const std::string text = read_file(file);
  EXPECT_HAS(text, "4 sqrt(m0)");
  EXPECT_HAS(text, "cut-off");
}

TEST(Sea, WritesTheKinematicsWithTheirOption) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "sea.csv";
  completed({"sea", kPoints, "--kinematics", "--duration-s", "4", "--step-s", "0.5", "-o", file, "--set",
             "sea.spreading.kind=cos2s", "--set", "sea.depth_m=15"});
  const std::vector<std::string> lines = data_lines(file);
  EXPECT_HAS(lines[0], "slope_y,velocity_x_mps,velocity_y_mps,velocity_z_mps,acceleration_x_mps2");
  const Scenario scenario =
      read_scenario(SEAGLINT_SOURCE_DIR "/" + kPoints, {{"sea.spreading.kind", "cos2s"}, {"sea.depth_m", "15"}});
  const WaveField field = realise_sea(sea_states(scenario.sea).front(), scenario.seed, sea_key(0, 0));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<double> row = numbers(lines[i]);
    ASSERT_EQ(row.size(), 11u);
    const SurfaceState surface = field.surface(0, 0, row[0]);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(row[static_cast<std::size_t>(5 + axis)], surface.velocity[axis], 1e-8);
      EXPECT_NEAR(row[static_cast<std::size_t>(8 + axis)], surface.acceleration[axis], 1e-8);
    }
  }
  EXPECT_HAS(read_file(file), "# depth_m 15, Ursell number");
}

// The file of the spectrum can be named as a spectrum by a scenario; statistics do not depend on threads.
TEST(Sea, WritesASpectrumThatAScenarioAccepts) {
  const TemporaryFolder folder;
  const std::filesystem::path one = folder.path() / "one.csv", two = folder.path() / "two.csv";
  const auto run = [&](const std::filesystem::path& spectrum, const std::string& threads) {
    return run_program({"sea", kPoints, "--duration-s", "200", "--realisations", "40", "--spectrum", spectrum,
                        "--threads", threads, "-o", folder.path() / "sea.csv"});
  };
  const ProgramResult result = completed(run(one, "1"));
  EXPECT_HAS(result.out, "40 realisations: 4 sigma ");
  EXPECT_HAS(result.out, "Forristall");
  EXPECT_EQ(run(two, "2").out, result.out);
  EXPECT_EQ(read_file(one), read_file(two));

  double target = 0, realised = 0;
  const std::vector<std::string> lines = data_lines(one);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    target += numbers(lines[i])[1];
    realised += numbers(lines[i])[3];
  }
  // Forty windowed records of 25 waves, about four of them with independent energy: 8 %; three times that.
  EXPECT_NEAR(realised / target, 1, 0.24);

  const ProgramResult again =
      completed({"sea", kPoints, "--duration-s", "1", "-o", folder.path() / "again.csv", "--set", "sea.spectrum=table",
                 "--set", "sea.table=" + one.string(), "--set", "sea.significant_wave_height_m=from_table"});
  EXPECT_HAS(again.out, "4 sqrt(m0) 0.99");  // the table ends at 1.2 times the cut-off
}

TEST(Sea, DrawsItsFigureOrLeavesNoFile) {
  const TemporaryFolder folder;
  const std::filesystem::path csv = folder.path() / "sea.csv", figure = folder.path() / "sea.png";
  completed({"sea", kPoints, "--duration-s", "100", "--realisations", "2", "--figure", figure, "-o", csv});
  EXPECT_GT(std::filesystem::file_size(figure), 20000u);
  std::filesystem::remove(csv);
  const ProgramResult wrong =
      run_program({"sea", kPoints, "--duration-s", "100", "--figure", folder.path() / "sea.bmp", "-o", csv});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_FALSE(std::filesystem::exists(csv));
  EXPECT_EQ(
      run_program({"sea", kPoints, "--figure", figure, "-o", csv, "--set", "sea.significant_wave_height_m=0"}).code, 2);
}

// Of several states a table has one more column, and each state has the rows that it has alone.
TEST(Sea, WritesEveryStateOfASweep) {
  const TemporaryFolder folder;
  const std::filesystem::path all = folder.path() / "all.csv", one = folder.path() / "one.csv",
                              spectra = folder.path() / "spectra.csv", figure = folder.path() / "sea.svg";
  const Words words{
      "sea", kPoints, "--duration-s", "100", "--realisations", "2", "--set", "sea.significant_wave_height_m=[0.5, 2]"};
  const ProgramResult result = completed(with(words, {"--figure", figure, "--spectrum", spectra, "-o", all}));
  EXPECT_HAS(result.out, "sea state 0, realisation 0\nsignificant_wave_height_m 0.5,");
  EXPECT_HAS(result.out, "sea state 1, realisation 0\nsignificant_wave_height_m 2,");
  const std::vector<std::string> lines = data_lines(all);
  EXPECT_EQ(lines[0], "sea_state,time_s,elevation_m,elevation_linear_m,slope_x,slope_y");
  for (const char* number : {"0", "1"}) {
    completed(with(words, {"--spectrum", folder.path() / "spectrum.csv", "--state", number, "-o", one}));
    const std::vector<std::string> alone = data_lines(one);
    ASSERT_EQ(lines.size(), 2 * alone.size() - 1);
    EXPECT_EQ(alone[0], "time_s,elevation_m,elevation_linear_m,slope_x,slope_y");
    const std::size_t first = *number == '0' ? 0 : alone.size() - 1;
    for (std::size_t i = 1; i < alone.size(); ++i) ASSERT_EQ(lines[first + i], number + ("," + alone[i]));
  }
  EXPECT_EQ(data_lines(spectra)[0],
            "sea_state,omega_rad_s,density_m2_s,realised_density_m2_s,realised_linear_density_m2_s");
  EXPECT_EQ(data_lines(spectra).size(), 2 * data_lines(folder.path() / "spectrum.csv").size() - 1);
  for (const char* word : {"Hs 0.5 m", "Hs 2 m", "Tp 8 s", "deep water", "seed "}) EXPECT_HAS(read_file(figure), word);
  expect_refused(with(words, {"--spectrum", spectra, "--state", "2", "-o", one}),
                 "--state 2: must be all or a number within 0 and 1");
  expect_refused(with(words, {"--spectrum", spectra, "--state", "first", "-o", one}),
                 "--state first: must be all or a number within 0 and 1");
}

TEST(Sea, RefusesInvalidRanges) {
  for (const auto& wrong : {std::pair{"--step-s", "0"}, std::pair{"--duration-s", "-1"}, std::pair{"--at", "1"},
                            std::pair{"--at", "nan,0"}, std::pair{"--duration-s", "nan"}, std::pair{"--step-s", "nan"}})
    EXPECT_EQ(run_program({"sea", kPoints, "-o", "unused.csv", wrong.first, wrong.second}).code, 2) << wrong.first;
  expect_refused({"sea", kPoints, "-o", "unused.csv", "--duration-s", "1e6", "--step-s", "1e-4"}, "rows");
  expect_refused({"sea", kPoints, "-o", "unused.csv", "--set", "sea.cutoff_rad_s=0.1"}, "cutoff_rad_s");
}

// Before the work, and so before the scenario or mesh, which are missing too.
TEST(Commands, CheckTheirOutputFilesFirst) {
  const TemporaryFolder folder;
  const std::string table = folder.path() / "table.csv", nowhere = "/nonexistent/file.png",
                    no_archive = "/nonexistent/file.npz";
  const std::vector<std::string> rcs{"rcs", "--target", "no.glb", "--frequency-ghz", "16", "--azimuth-deg", "0"};
  for (const auto& words : {Words{"sea", "no.yaml", "-o", nowhere},
                            {"sea", "no.yaml", "-o", table, "--figure", nowhere},
                            {"motion", "no.yaml", "-o", nowhere},
                            {"motion", "no.yaml", "-o", table, "--rao", nowhere},
                            {"map", "no.yaml", "-o", nowhere},
                            {"echo", "no.yaml", "-o", no_archive},
                            with(rcs, {"-o", nowhere}),
                            with(rcs, {"-o", table, "--export-scattering-centres", nowhere})}) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 1) << words.front();
    EXPECT_HAS(result.err,
               (words.front() == "echo" ? no_archive : nowhere) + ": cannot write: No such file or directory");
  }
  for (const auto& words : {Words{"sea", "no.yaml", "-o", table, "--figure", "figure.bmp"},
                            {"motion", "no.yaml", "-o", table, "--snapshots", "figure.bmp"},
                            {"map", "no.yaml", "-o", "figure.bmp"}})
    expect_refused(words, "figure.bmp: a figure's name ends in .png, .svg or .pdf");
}

// Rotations of WAMIT are per wamit_ulen_m, and waves of finite depth are shorter.
TEST(Motion, DrawsRaosInTheScenariosUnitsAndDepth) {
  const TemporaryFolder folder;
  const auto picture = [&](const std::string& scale, const std::vector<std::string>& settings) {
    const std::string reference = folder.path() / "ship.4", figure = folder.path() / "rao.svg";
    std::string rows;
    for (const char* period : {"6", "8", "12"})
      for (int mode = 1; mode <= 6; ++mode) rows += fmt::format("{0} 120 {1} {2} 0 {2} 0\n", period, mode, scale);
    write_file(reference, rows);
    // The numbers are those of no body.
    Words words = with({"motion", "scenarios/quick.yaml", "--state", "0", "--duration-s", "1", "--set",
                        "targets.ship.motion.rao_follows_long_waves=false"},
                       {"-o", folder.path() / "motion.csv", "--rao", figure, "--rao-reference", reference});
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    completed(words);
    return read_file(figure);
  };
  const std::string of_metres = picture("0.02", {});
  EXPECT_EQ(picture("2", {"targets.ship.motion.wamit_ulen_m=100"}), of_metres);
  EXPECT_NE(picture("0.02", {"sea.depth_m=12"}), of_metres);
}

TEST(Motion, WritesEveryBodyAtEveryTime) {
  const TemporaryFolder folder;
  const std::string scenario = write_boxes(folder.path()), file = folder.path() / "motion.csv";
  completed({"motion", scenario, "--state", "0", "--duration-s", "2", "--step-s", "0.1", "-o", file});
  const std::vector<std::string> lines = data_lines(file);
  ASSERT_EQ(lines.size(), 1 + 21 * 3u);
  EXPECT_EQ(lines[0], "time_s,body,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m");
  EXPECT_HAS(lines[1], "0,ship,");
  EXPECT_HAS(lines[2], "0,array_1,");
  EXPECT_HAS(lines[3], "0,array_2,");
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_EQ(numbers(lines[i]).size(), 8u);
}

TEST(Motion, WritesAndDrawsEveryStateOfASweep) {
  const TemporaryFolder folder;
  const std::string scenario = write_boxes(folder.path()), file = folder.path() / "motion.csv";
  const std::filesystem::path figure = folder.path() / "motion.svg", frames = folder.path() / "frames.svg";
  for (const char* style : {"screen", "paper", "paper-wide"}) {
    const ProgramResult result = completed({"motion", scenario, "--duration-s", "2", "--figure", figure, "--snapshots",
                                            frames, "--style", style, "-o", file});
    EXPECT_HAS(result.out, "sea state 0: Hs 1 m\nship: roll");
    EXPECT_HAS(result.out, "sea state 1: Hs 2 m\nship: roll");
    for (const char* word : {">Hs 1 m<", ">Hs 2 m<", "array_2", "boxes: Tp 8 s", "deep water"})
      EXPECT_HAS(read_file(figure), word);
    EXPECT_HAS(read_file(frames), "array_2, 0.0 s");
  }
  const std::vector<std::string> lines = data_lines(file);
  ASSERT_EQ(lines.size(), 1 + 2 * 21 * 3u);
  EXPECT_EQ(lines[0], "sea_state,time_s,body,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m");
  EXPECT_HAS(lines[1], "0,0,ship,");
  EXPECT_HAS(lines[64], "1,0,ship,");
}

TEST(Motion, DoesNotDependOnThreads) {
  const TemporaryFolder folder;
  const std::string scenario = write_boxes(folder.path());
  const std::filesystem::path one = folder.path() / "one.csv", two = folder.path() / "two.csv";
  completed({"motion", scenario, "--duration-s", "2", "--threads", "1", "-o", one});
  completed({"motion", scenario, "--duration-s", "2", "--threads", "2", "-o", two});
  EXPECT_EQ(read_file(one), read_file(two));
}

TEST(Motion, NeedsATargetWithAMesh) { expect_refused({"motion", kPoints, "-o", "unused.csv"}, "targets"); }

}  // namespace
}  // namespace seaglint

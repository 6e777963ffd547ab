// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/pipeline/program.h"
#include "tests/pipeline/rcs_command.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::Not;

// `seaglint rcs --converge` on a duct whose rays depend on the smallest patch.

class Convergence : public testing::Test {
 protected:
  ProgramResult rcs(const std::string& table, Words more) const {
    return run_program({"rcs", "--target", "tests/reference/rcs/austin/duct_box.glb", "--frequency-ghz", "10",
                        "--azimuth-deg", "170:180:10", "--max-bounces", "4", "-o", folder_.path() / table},
                       more);
  }
  CsvTable table(const std::string& name) const { return read_table(folder_.path() / name); }

  TemporaryFolder folder_;
};

// The table is that of a sweep with the last patch, to the printed digits; the columns are its levels less those of a
// sweep with twice the patch.
TEST_F(Convergence, EndsWithTwoSweepsOfEqualLevels) {
  const ProgramResult result = completed(rcs("converged.csv", {"--converge", "0.05"}));
  std::vector<std::string> patches;
  const std::regex line("patches of ([0-9.e-]+) m and more");
  for (std::sregex_iterator it(result.err.begin(), result.err.end(), line), end; it != end; ++it)
    patches.push_back((*it)[1]);
  ASSERT_GE(patches.size(), 2u) << result.err;
  const double last = std::stod(patches.back()), before = std::stod(patches[patches.size() - 2]);
  EXPECT_NEAR(before / last, 2, 1e-3);  // four printed digits

  const std::string head = read_file(folder_.path() / "converged.csv");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(head, found, std::regex("min_patch_m ([0-9.e-]+)\n")));
  const double patch = std::stod(found[1]);
  completed(rcs("fine.csv", {"--min-patch-m", fmt::format("{}", patch)}));
  completed(rcs("coarse.csv", {"--min-patch-m", fmt::format("{}", 2 * patch)}));
  const CsvTable converged = table("converged.csv"), fine = table("fine.csv"), coarse = table("coarse.csv");
  EXPECT_THAT(converged.header, testing::EndsWith(",vv_dbsm,hh_patch_change_db,vv_patch_change_db"));
  for (std::size_t i = 0; i < fine.rows.size(); ++i) {
    for (const std::size_t element : {0u, 1u}) {
      // Four digits behind the point in each; patches at the limit between two of the printed ones are 1e-5 of all.
      EXPECT_NEAR(converged.rows[i][11 + element], fine.rows[i][11 + element], 1e-3);
      EXPECT_NEAR(converged.rows[i][13 + element], fine.rows[i][11 + element] - coarse.rows[i][11 + element], 2e-3);
      EXPECT_LE(std::abs(converged.rows[i][13 + element]), 0.05);
    }
  }
}

// The physical optics of a flat plate does not depend on the distance between rays: the first halving is the last.
TEST_F(Convergence, OfRaysHalvesTheDistanceBetweenThem) {
  const std::string plate = folder_.path() / "plate.glb", converged = folder_.path() / "plate.csv";
  completed({"mesh", "make", "plate", "--length-m", "0.5", "--width-m", "0.3", "-o", plate});
  const ProgramResult result = completed({"rcs", "--target", plate, "--frequency-ghz", "10", "--azimuth-deg", "0:4:2",
                                          "--edges", "off", "--method", "rays", "--ray-spacing-m", "0.02",
                                          "--min-patch-m", "0.001", "--converge", "0.01", "-o", converged});
  EXPECT_THAT(result.err, testing::AllOf(HasSubstr("rays 0.02 m apart: "), HasSubstr("rays 0.01 m apart: "),
                                         testing::Not(HasSubstr("patches of"))));
  EXPECT_HAS(read_file(converged), ", min_patch_m 0.001, method rays, ray_spacing_m 0.01\n");
  const CsvTable swept = read_table(converged);
  EXPECT_THAT(swept.header, testing::EndsWith(",vv_dbsm,hh_spacing_change_db,vv_spacing_change_db"));
  for (const std::vector<double>& row : swept.rows) EXPECT_LE(std::abs(row[13]), 0.01);
}

TEST_F(Convergence, OfACavityIsRefused) {
  expect_refused(rcs("rcs.csv", {"--converge", "0.1", "--cavity", "duct"}), "--converge halves the patches of beams");
}

// `seaglint rcs --cross-check` as a user runs it.

class CrossCheckCommand : public RcsCommand {
 protected:
  ProgramResult check(Words more) const {
    return run_program(
        {"rcs", "--target", plate(), "--frequency-ghz", "9:10:1", "--azimuth-deg", "0:40:20", "--cross-check"}, more);
  }
};

TEST_F(CrossCheckCommand, PrintsEveryViewAndASummaryWithoutAFile) {
  const ProgramResult result = completed(check({}));
  EXPECT_HAS(result.out, "azimuth_deg elevation_deg  element beams_dbsm rays_dbsm");
  EXPECT_THAT(result.out, testing::ContainsRegex("\n +40 +0  vv "));
  EXPECT_HAS(result.out, "Relative difference of 6 rows: median ");
  EXPECT_FALSE(std::filesystem::exists(table()));
}

// The levels are those of the sweeps by each method, as mean cross-section over the two frequencies.
TEST_F(CrossCheckCommand, WritesATableWithTheLevelsOfBothSweeps) {
  completed(check({"-o", table(), "--ray-spacing-m", "0.005"}));
  const std::string text = read_file(table());
  EXPECT_HAS(text, "# rays: ray_spacing_m 0.005\n");
  std::vector<std::vector<std::string>> cells;  // of the rows
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    cells.emplace_back();
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) cells.back().push_back(word);
  }
  ASSERT_EQ(cells.size(), 7u);  // with the header
  EXPECT_EQ(cells[0][3], "beams_dbsm");
  EXPECT_EQ(cells[0][4], "rays_dbsm");
  for (const std::size_t method : {0u, 1u}) {
    const std::string sweep = folder_.path() / "sweep.csv";
    Words words{"rcs",     "--target", plate(), "--frequency-ghz", "9:10:1", "--azimuth-deg",
                "0:40:20", "-o",       sweep,   "--method"};
    words.emplace_back(method == 0 ? "beams" : "rays");
    if (method == 1) words.insert(words.end(), {"--ray-spacing-m", "0.005"});
    completed(words);
    const CsvTable rcs = read_table(sweep);
    for (std::size_t i = 0; i < 6; ++i) {
      double area = 0;
      for (const std::size_t q : {0u, 1u}) area += std::pow(10, rcs.rows[3 * q + i / 2][11 + i % 2] / 10) / 2;
      EXPECT_NEAR(std::stod(cells[1 + i][3 + method]), 10 * std::log10(area), 2e-4) << cells[1 + i][0];
    }
  }
}

TEST_F(CrossCheckCommand, WithAMethodACavityOrConvergenceIsRefused) {
  for (const Words& more : std::vector<Words>{
           {"--method", "rays"}, {"--cavity", "plate"}, {"--converge", "0.1"}, {"--reference", "cut.csv"}}) {
    const ProgramResult result = check(more);
    EXPECT_EQ(result.code, 2) << more[0];
    EXPECT_HAS(result.err, "--cross-check excludes " + more[0]);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
  }
}

TEST_F(CrossCheckCommand, WithoutItAnOutputIsRequired) {
  expect_refused({"rcs", "--target", plate(), "--frequency-ghz", "9", "--azimuth-deg", "0"},
                 "--output or --cross-check is required");
}

TEST_F(CrossCheckCommand, OverItsOwnMeshIsRefused) {
  const std::string mesh = read_file(plate());
  EXPECT_EQ(check({"-o", plate()}).code, 2);
  EXPECT_EQ(read_file(plate()), mesh);
}

// `seaglint rcs --uncertainty`: its warning, columns and figures.

class UncertainRcs : public RcsCommand {
 protected:
  std::string cylinder() const { return folder_.path() / "cylinder.obj"; }
  // `rcs --uncertainty` of the cylinder with more words.
  ProgramResult uncertain(const Words& more) const {
    return run_program({"rcs", "--target", cylinder(), "--frequency-ghz", "10", "--azimuth-deg", "0:45:1", "-o",
                        table(), "--uncertainty"},
                       more);
  }
};

TEST_F(UncertainRcs, WarnsWhereFlatFacetsWouldDiffer) {
  completed({"mesh", "make", "cylinder", "--segments", "48", "-o", cylinder()});
  std::string tables[2];
  for (const char* threads : {"1", "2"}) {
    const ProgramResult result = completed(uncertain({"--threads", threads}));
    EXPECT_HAS(result.err, "warning: part 'cylinder': with flat facets in place of smooth surfaces");
    EXPECT_HAS(result.out, "Figure: ");
    tables[threads[0] - '1'] = read_file(table());
  }
  EXPECT_EQ(tables[0], tables[1]);
  EXPECT_HAS(tables[0], "# warning: part 'cylinder': with flat facets");
  EXPECT_EQ(read_table(table()).rows.front().size(), 17u);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "rcs.png"));

  // A table with these columns is a reference, and the picture of the comparison has the band.
  const std::string reference = folder_.path() / "reference.V.csv", figure = folder_.path() / "comparison.svg";
  std::filesystem::rename(table(), reference);
  completed(uncertain({"--reference", reference, "--figure", figure}));
  EXPECT_HAS(read_file(figure), "to flat facets");
}

TEST_F(UncertainRcs, DoesNotWarnOfAPlate) {
  EXPECT_THAT(completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "-30:30:1"})).err, Not(HasSubstr("part '")));
  EXPECT_THAT(read_file(table()), Not(HasSubstr("flat facets")));
}

// hh and vv with their percentiles beside the table, unless the figure is not wanted or the sweep is too short.
TEST_F(UncertainRcs, OfAPlateIsDrawnByDefault) {
  const std::filesystem::path figure = std::filesystem::path(table()).replace_extension(".png");
  const Words sweep{"--frequency-ghz", "10", "--azimuth-deg", "-30:30:1"};
  const std::string out = completed(rcs(sweep)).out;
  EXPECT_HAS(out, "Figure: " + figure.string());
  EXPECT_HAS(out, "hh,      10 GHz");
  EXPECT_TRUE(std::filesystem::remove(figure));
  EXPECT_THAT(completed(rcs(with(sweep, {"--figure", "off"}))).out, Not(HasSubstr("Figure: ")));
  EXPECT_FALSE(std::filesystem::exists(figure));
  // Nothing is put beside a device.
  EXPECT_THAT(completed({"rcs", "--target", "assets/icosahedral_reflector.glb", "--frequency-ghz", "10",
                         "--azimuth-deg", "0:20:2", "-o", "/dev/null"})
                  .out,
              Not(HasSubstr("Figure: ")));
  EXPECT_HAS(completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--figure", figure})).out,
             "No figure: it needs a cut along azimuth, elevation or frequency of 8 points or more");
}

// `seaglint mesh sensitivity`: the echo on other meshes of the same surface.

// Numbers of the table, one row per view.
std::vector<std::vector<double>> rows_of(const std::string& table) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#") || line.find("azimuth_deg") != std::string::npos) continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (double cell; cells >> cell;) rows.back().push_back(cell);
  }
  return rows;
}

Words words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

enum Column { kAzimuth, kElevation, kHh, kVv, kCut, kCutFloat, kRenumbered, kTurned, kMoved, kNoise, kFlat, kColumns };

class MeshSensitivityCommand : public testing::Test {
 protected:
  std::string made(const std::string& what) const {
    std::string file = folder_.path() / "mesh.glb";
    completed(words("mesh make " + what + " -o " + file));
    return file;
  }
  ProgramResult sensitivity(const std::string& file, const std::string& more) const {
    return run_program(words("mesh sensitivity --target " + file + " --frequency-ghz 10 " + more));
  }

  TemporaryFolder folder_;
};

// A trihedral has no smooth facets. Noise of sigma on a plate changes the phase by 2 k sigma / sqrt(2) and less: at
// most three reflections by planes through noisy corners, 6 k sigma.
TEST_F(MeshSensitivityCommand, OfATrihedralIsThatOfTheNoise) {
  const std::string file = made("trihedral --leg-m 0.4");
  const ProgramResult result = completed(sensitivity(file, "--azimuth-deg 30:60:15 --elevation-deg 35 --noise-um 20"));
  const auto rows = rows_of(result.out);
  ASSERT_EQ(rows.size(), 3u);
  constexpr double kNoisePhase = 6 * 209.6 * 20e-6;  // k at 10 GHz
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), static_cast<std::size_t>(kColumns));
    for (const Column column : {kCut, kCutFloat, kRenumbered, kTurned, kMoved, kFlat}) EXPECT_LT(row[column], 1e-3);
    EXPECT_GT(row[kNoise], 0);
    EXPECT_LT(row[kNoise], kNoisePhase);
  }
  EXPECT_EQ(rows[1][kAzimuth], 45);
  EXPECT_EQ(rows[1][kElevation], 35);
}

// Flat facets of 1.7 cm on a sphere of 0.3 m: 1.5 dB at ka 63.
TEST_F(MeshSensitivityCommand, ShowsWhereSmoothAndFlatFacetsDiffer) {
  const std::string file = made("sphere --radius-m 0.3 --subdivisions 3");
  const ProgramResult result = completed(sensitivity(file, "--azimuth-deg 11 --elevation-deg 23"));
  const auto rows = rows_of(result.out);
  ASSERT_EQ(rows.size(), 1u);
  for (const Column column : {kCut, kRenumbered, kTurned, kMoved}) EXPECT_LT(rows[0][column], 0.02);
  EXPECT_GT(rows[0][kFlat], 0.1);
}

TEST_F(MeshSensitivityCommand, IsTheSameForOneAndTwoThreads) {
  const std::string file = made("reflector");
  const auto table = [&](const char* threads) {
    return sensitivity(file, "--azimuth-deg 0:40:20 --threads " + std::string(threads)).out;
  };
  EXPECT_FALSE(rows_of(table("1")).empty());
  EXPECT_EQ(table("1"), table("2"));
}

// `seaglint rcs --cavity`: a part whose echo is computed from the field inside it.

constexpr const char* kBox = SEAGLINT_SOURCE_DIR "/tests/reference/rcs/austin/duct_box.glb";  // parts box and duct

class CavityCommand : public testing::Test {
 protected:
  std::string table() const { return folder_.path() / "rcs.csv"; }
  ProgramResult rcs(Words more) const { return run_program({"rcs", "--target", kBox, "-o", table()}, more); }
  // The numbers of every row of a sweep at 3 GHz towards the aperture.
  std::vector<std::vector<double>> sweep(Words more) const {
    completed(rcs(with(
        {"--frequency-ghz", "3", "--azimuth-deg", "120:240:30", "--elevation-deg", "5", "--max-bounces", "4"}, more)));
    return read_table(table()).rows;
  }

  TemporaryFolder folder_;
};

TEST_F(CavityCommand, ReplacesTheBeamsThatLeaveThePart) {
  const auto rays = sweep({}), whole = sweep({"--cavity", "duct"});
  EXPECT_HAS(read_file(table()), "# cavities duct: from the currents on their walls");
  const auto inside = sweep({"--cavity", "duct", "--only", "part=duct"}),
             outside = sweep({"--cavity", "duct", "--without", "part=duct"});
  ASSERT_EQ(whole.size(), 5u);
  double changed = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    // Nine digits are printed.
    for (std::size_t c = 3; c < 11; ++c) EXPECT_NEAR(whole[i][c], inside[i][c] + outside[i][c], 1e-8) << i << ' ' << c;
    changed = std::max(changed, std::hypot(whole[i][3] - rays[i][3], whole[i][4] - rays[i][4]));
    EXPECT_GT(std::hypot(inside[i][3], inside[i][4]), 1e-3);
  }
  EXPECT_GT(changed, 1e-2);
}

TEST_F(CavityCommand, ChangesNothingWhereTheApertureIsNotVisible) {
  const auto behind = [&](Words more) {
    completed(rcs(with({"--frequency-ghz", "3", "--azimuth-deg", "20", "--max-bounces", "4"}, more)));
    std::string text = read_file(table());
    return text.substr(text.rfind("\n3e+09") + 1);
  };
  EXPECT_EQ(behind({}), behind({"--cavity", "duct"}));
}

TEST_F(CavityCommand, RefusesPartsThatAreNoCavity) {
  const auto refused = [&](Words more, const std::string& message) {
    expect_refused(rcs(with({"--azimuth-deg", "180", "--elevation-deg", "5"}, more)), message);
    EXPECT_FALSE(std::filesystem::exists(table()));
  };
  refused({"--frequency-ghz", "3", "--cavity", "dukt"}, "--cavity dukt: the mesh has no such part");
  refused({"--frequency-ghz", "3", "--cavity", "box"}, "face away from its inside");
  refused({"--frequency-ghz", "94", "--cavity", "duct"}, "patches of 0.000532 m at this wavelength: at most 20000");
  refused({"--frequency-ghz", "3", "--cavity", "duct", "--sea-reflection", "--origin-height-m", "2"},
          "--cavity does not support --sea-reflection");
  refused({"--frequency-ghz", "3", "--cavity", "duct", "--wavefront-range-m", "100"},
          "does not support --sea-reflection, --wavefront-range-m");
  refused({"--frequency-ghz", "3", "--cavity", "duct", "--only", "mechanism=edge"}, "select with part=NAME");
  const std::string coating = SEAGLINT_SOURCE_DIR "/assets/materials/ram_loaded_epoxy.yaml";
  refused({"--frequency-ghz", "16", "--cavity", "duct", "--material", coating}, "its walls must be pec, not");
  refused({"--frequency-ghz", "3", "--cavity-patches-per-wavelength", "8"},
          "--cavity-patches-per-wavelength requires --cavity");
  refused({"--frequency-ghz", "3", "--cavity", "duct", "--cavity-patches-per-wavelength", "2"},
          "--cavity-patches-per-wavelength");
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// `seaglint rcs --cross-check` as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/pipeline/rcs_command.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

class CrossCheckCommand : public RcsCommand {
 protected:
  ProgramResult check(std::vector<std::string> more) const {
    more.insert(more.begin(),
                {"rcs", "--target", plate(), "--frequency-ghz", "9:10:1", "--azimuth-deg", "0:40:20", "--cross-check"});
    return run_program(more);
  }
};

TEST_F(CrossCheckCommand, PrintsEveryViewAndASummaryWithoutAFile) {
  const ProgramResult result = check({});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("azimuth_deg elevation_deg  element beams_dbsm rays_dbsm"));
  EXPECT_THAT(result.out, testing::ContainsRegex("\n +40 +0  vv "));
  EXPECT_THAT(result.out, HasSubstr("Relative difference of 6 rows: median "));
  EXPECT_FALSE(std::filesystem::exists(table()));
}

// The levels are those of the sweeps by each method, as mean cross-section over the two frequencies.
TEST_F(CrossCheckCommand, WritesATableWithTheLevelsOfBothSweeps) {
  ASSERT_EQ(check({"-o", table(), "--ray-spacing-m", "0.005"}).code, 0);
  const std::string text = read_file(table());
  EXPECT_THAT(text, HasSubstr("# rays: ray_spacing_m 0.005\n"));
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
    std::vector<std::string> words{"rcs",     "--target", plate(), "--frequency-ghz", "9:10:1", "--azimuth-deg",
                                   "0:40:20", "-o",       sweep,   "--method"};
    words.emplace_back(method == 0 ? "beams" : "rays");
    if (method == 1) words.insert(words.end(), {"--ray-spacing-m", "0.005"});
    ASSERT_EQ(run_program(words).code, 0);
    const CsvTable rcs = read_table(sweep);
    for (std::size_t i = 0; i < 6; ++i) {
      double area = 0;
      for (const std::size_t q : {0u, 1u}) area += std::pow(10, rcs.rows[3 * q + i / 2][11 + i % 2] / 10) / 2;
      EXPECT_NEAR(std::stod(cells[1 + i][3 + method]), 10 * std::log10(area), 2e-4) << cells[1 + i][0];
    }
  }
}

TEST_F(CrossCheckCommand, WithAMethodACavityOrConvergenceIsRefused) {
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--method", "rays"}, {"--cavity", "plate"}, {"--converge", "0.1"}, {"--reference", "cut.csv"}}) {
    const ProgramResult result = check(more);
    EXPECT_EQ(result.code, 2) << more[0];
    EXPECT_THAT(result.err, HasSubstr("--cross-check excludes " + more[0]));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
  }
}

TEST_F(CrossCheckCommand, WithoutItAnOutputIsRequired) {
  const ProgramResult result = run_program({"rcs", "--target", plate(), "--frequency-ghz", "9", "--azimuth-deg", "0"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--output or --cross-check is required"));
}

TEST_F(CrossCheckCommand, OverItsOwnMeshIsRefused) {
  const std::string mesh = read_file(plate());
  EXPECT_EQ(check({"-o", plate()}).code, 2);
  EXPECT_EQ(read_file(plate()), mesh);
}

}  // namespace
}  // namespace seaglint

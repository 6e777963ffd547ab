// SPDX-License-Identifier: BSD-3-Clause
// `seaglint rcs --converge` on a duct whose rays depend on the smallest patch.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "tests/pipeline/rcs_command.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

class Convergence : public testing::Test {
 protected:
  ProgramResult rcs(const std::string& table, std::vector<std::string> more) const {
    more.insert(more.begin(), {"rcs", "--target", "tests/reference/rcs/austin/duct_box.glb", "--frequency-ghz", "10",
                               "--azimuth-deg", "170:180:10", "--max-bounces", "4", "-o", folder_.path() / table});
    return run_program(more);
  }
  CsvTable table(const std::string& name) const { return read_table(folder_.path() / name); }

  TemporaryFolder folder_;
};

// The table is that of a sweep with the last patch, to the printed digits; the columns are its levels less those of a
// sweep with twice the patch.
TEST_F(Convergence, EndsWithTwoSweepsOfEqualLevels) {
  const ProgramResult result = rcs("converged.csv", {"--converge", "0.05"});
  ASSERT_EQ(result.code, 0) << result.err;
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
  ASSERT_EQ(rcs("fine.csv", {"--min-patch-m", fmt::format("{}", patch)}).code, 0);
  ASSERT_EQ(rcs("coarse.csv", {"--min-patch-m", fmt::format("{}", 2 * patch)}).code, 0);
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
  ASSERT_EQ(run_program({"mesh", "make", "plate", "--length-m", "0.5", "--width-m", "0.3", "-o", plate}).code, 0);
  const ProgramResult result = run_program({"rcs", "--target", plate, "--frequency-ghz", "10", "--azimuth-deg", "0:4:2",
                                            "--edges", "off", "--method", "rays", "--ray-spacing-m", "0.02",
                                            "--min-patch-m", "0.001", "--converge", "0.01", "-o", converged});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, testing::AllOf(HasSubstr("rays 0.02 m apart: "), HasSubstr("rays 0.01 m apart: "),
                                         testing::Not(HasSubstr("patches of"))));
  EXPECT_THAT(read_file(converged), HasSubstr(", min_patch_m 0.001, method rays, ray_spacing_m 0.01\n"));
  const CsvTable swept = read_table(converged);
  EXPECT_THAT(swept.header, testing::EndsWith(",vv_dbsm,hh_spacing_change_db,vv_spacing_change_db"));
  for (const std::vector<double>& row : swept.rows) EXPECT_LE(std::abs(row[13]), 0.01);
}

TEST_F(Convergence, OfACavityIsRefused) {
  const ProgramResult result = rcs("rcs.csv", {"--converge", "0.1", "--cavity", "duct"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--converge halves the patches of beams"));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// `seaglint rcs --cavity`: a part whose echo is computed from the field inside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

constexpr const char* kBox = SEAGLINT_SOURCE_DIR "/tests/reference/rcs/austin/duct_box.glb";  // parts box and duct

class CavityCommand : public testing::Test {
 protected:
  std::string table() const { return folder_.path() / "rcs.csv"; }
  ProgramResult rcs(std::vector<std::string> more) const {
    more.insert(more.begin(), {"rcs", "--target", kBox, "-o", table()});
    return run_program(more);
  }
  // The numbers of every row of a sweep at 3 GHz towards the aperture.
  std::vector<std::vector<double>> sweep(std::vector<std::string> more) const {
    more.insert(more.begin(),
                {"--frequency-ghz", "3", "--azimuth-deg", "120:240:30", "--elevation-deg", "5", "--max-bounces", "4"});
    const ProgramResult done = rcs(more);
    EXPECT_EQ(done.code, 0) << done.err;
    std::vector<std::vector<double>> rows;
    std::istringstream lines(read_file(table()));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("#") || line.starts_with("frequency")) continue;
      std::istringstream cells(line);
      rows.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
    }
    return rows;
  }

  TemporaryFolder folder_;
};

TEST_F(CavityCommand, ReplacesTheBeamsThatLeaveThePart) {
  const auto rays = sweep({}), whole = sweep({"--cavity", "duct"});
  EXPECT_THAT(read_file(table()), HasSubstr("# cavities duct: from the currents on their walls"));
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
  const auto behind = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"--frequency-ghz", "3", "--azimuth-deg", "20", "--max-bounces", "4"});
    EXPECT_EQ(rcs(more).code, 0);
    std::string text = read_file(table());
    return text.substr(text.rfind("\n3e+09") + 1);
  };
  EXPECT_EQ(behind({}), behind({"--cavity", "duct"}));
}

TEST_F(CavityCommand, RefusesPartsThatAreNoCavity) {
  const auto refused = [&](std::vector<std::string> more, const std::string& message) {
    more.insert(more.begin(), {"--azimuth-deg", "180", "--elevation-deg", "5"});
    const ProgramResult result = rcs(more);
    EXPECT_EQ(result.code, 2) << message;
    EXPECT_THAT(result.err, HasSubstr(message));
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

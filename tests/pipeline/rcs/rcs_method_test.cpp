// SPDX-License-Identifier: BSD-3-Clause
// `seaglint rcs --method` on a plate, whose physical optics has a closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "tests/pipeline/rcs_command.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

class RcsMethod : public RcsCommand {
 protected:
  ProgramResult at_normal_incidence(std::vector<std::string> more) const {
    more.insert(more.begin(), {"--frequency-ghz", "10", "--azimuth-deg", "0", "--edges", "off"});
    return rcs(more);
  }
  void expect_refusal(const std::vector<std::string>& more, const std::string& message) const {
    const ProgramResult result = at_normal_incidence(more);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.err, testing::StartsWith("seaglint: "));
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(table()));
  }
};

// Normal incidence on a plate of area A: 4 pi (A / lambda)^2.
TEST_F(RcsMethod, APlateHasItsClosedFormByEachOfThem) {
  const double expected = dbsm(kLengthM * kWidthM * 10e9 / kSpeedOfLight);
  for (const std::vector<std::string>& method : {std::vector<std::string>{},
                                                 {"--method", "beams"},
                                                 {"--method", "rays"},
                                                 {"--method", "rays", "--ray-spacing-m", "0.01"}}) {
    const ProgramResult result = at_normal_incidence(method);
    ASSERT_EQ(result.code, 0) << result.err;
    const CsvTable swept = read_table(table());
    ASSERT_EQ(swept.rows.size(), 1u);
    EXPECT_NEAR(swept.rows[0][12], expected, 1e-4);
  }
  EXPECT_THAT(read_file(table()), HasSubstr(", method rays, ray_spacing_m 0.01\n"));
}

TEST_F(RcsMethod, HeadsTheScatteringCentresToo) {
  const std::string centres = folder_.path() / "centres.csv";
  ASSERT_EQ(at_normal_incidence({"--export-scattering-centres", centres}).code, 0);
  EXPECT_THAT(read_file(centres), HasSubstr(", edges off, contributions: all\n"));
  ASSERT_EQ(
      at_normal_incidence({"--export-scattering-centres", centres, "--method", "rays", "--ray-spacing-m", "0.01"}).code,
      0);
  EXPECT_THAT(read_file(centres), HasSubstr(", edges off, method rays, ray_spacing_m 0.01, contributions: all\n"));
}

TEST_F(RcsMethod, OfAnotherNameIsRefusedWithThoseThatExist) {
  expect_refusal({"--method", "sbr"}, "--method: sbr not in {beams,rays}");
}

TEST_F(RcsMethod, OfBeamsHasNoDistanceBetweenRays) {
  const std::string message = "--ray-spacing-m: value 0.01: valid only with --method rays; beams have --min-patch-m";
  expect_refusal({"--ray-spacing-m", "0.01"}, message);
  expect_refusal({"--method", "beams", "--ray-spacing-m", "0.01"}, message);
  expect_refusal({"--method", "rays", "--ray-spacing-m", "-1"}, "--ray-spacing-m: value -1: must be within");
  const ProgramResult sensitivity = run_program({"mesh", "sensitivity", "--target", plate(), "--frequency-ghz", "10",
                                                 "--azimuth-deg", "0", "--ray-spacing-m", "0.01"});
  EXPECT_EQ(sensitivity.code, 2);
  EXPECT_THAT(sensitivity.err, HasSubstr(message));
}

// Cuts, numbers and positions of the triangles do not change the echo of a plate at normal incidence.
TEST_F(RcsMethod, OfRaysServesTheSensitivityToTheMesh) {
  const ProgramResult result =
      run_program({"mesh", "sensitivity", "--target", plate(), "--frequency-ghz", "10", "--azimuth-deg", "0", "--edges",
                   "off", "--method", "rays", "--ray-spacing-m", "0.01"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("0.0000      0.0000      0.0000      0.0000      0.0000"));
}

TEST_F(RcsMethod, OfRaysIsRefusedForACavity) {
  expect_refusal({"--method", "rays", "--cavity", "plate"},
                 "--cavity does not support --method rays: only beams end at the walls of cavities");
}

}  // namespace
}  // namespace seaglint

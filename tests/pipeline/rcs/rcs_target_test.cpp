// SPDX-License-Identifier: BSD-3-Clause
// `seaglint rcs`: warnings about its target, the target's materials, and the sea below it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/pipeline/rcs_command.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using RcsTarget = RcsCommand;

// A reflector inside out with a mesh with a hole next to it: the first is repaired, the interior of the second is
// visible; both are reported in one line each.
TEST_F(RcsTarget, WarnsOfDefectsOfAMeshAndContinues) {
  TriangleMesh mesh = make_icosahedral_reflector();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  TriangleMesh holed = transformed(make_sphere(0.3, 2), Mat3::Identity(), Vec3(0, 3, 0));
  holed.triangles[0] = holed.triangles[1];
  mesh.append(holed);
  write_mesh(plate(), mesh);
  const ProgramResult result = rcs({"--frequency-ghz", "0.1:10:9.9", "--azimuth-deg", "0"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err,
              testing::StartsWith("seaglint: warning: 1 triangle repeats another: removed\n"
                                  "seaglint: warning: 1 closed surface is inside out (60 triangles): turned outwards\n"
                                  "seaglint: warning: 3 open edges; 1 of 2 surfaces are open"));
  EXPECT_THAT(result.err, HasSubstr("wavelengths at 0.1 GHz; physical optics needs 3 and more"));
}

TEST_F(RcsTarget, RefusesMeshesWithoutAnythingThatScatters) {
  const std::string file = folder_.path() / "bad.obj";
  const auto refused = [&](const std::string& text, const std::string& message) {
    write_file(file, text);
    const ProgramResult result =
        run_program({"rcs", "--target", file, "-o", table(), "--frequency-ghz", "10", "--azimuth-deg", "0"});
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(table()));
  };
  refused("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle has an area: nothing scatters");
  refused("v 0 0 0\nv 1 0 0\nv 0 nan 1\nf 1 2 3\n", "bad.obj");
  refused("v 0 0 0\nv 1 0 0\nv 0 1 1\n", "contains no triangles");
  refused("v 9000 0 0\nv 9000 1 0\nv 9000 0 1\nf 1 2 3\n", "from the origin");
}

TEST_F(RcsTarget, IncludesTheThicknessOfSheets) {
  ASSERT_EQ(run_program({"mesh", "make", "plate", "--length-m", "0.3", "--width-m", "0.2", "-o", plate()}).code, 0);
  const auto level = [&](const char* thickness_mm, const char* edges, const char* warning) {
    const ProgramResult run =
        rcs({"--frequency-ghz", "10", "--azimuth-deg", "50", "--sheet-thickness-mm", thickness_mm, "--edges", edges});
    EXPECT_EQ(run.code, 0);
    EXPECT_THAT(run.err, HasSubstr(warning));
    return read_table(table()).rows.at(0).back();
  };
  const double thin = level("0", "on", ""), thick = level("1.6", "on", "");
  EXPECT_GT(std::abs(thick - thin), 0.3);
  EXPECT_THAT(read_file(table()), HasSubstr("sheet_thickness_mm 1.6"));
  EXPECT_DOUBLE_EQ(level("1.6", "off", "sheet thickness of 1.6 mm has no effect: edges are off"),
                   level("0", "off", ""));
  level("4", "on", "sheets of 4 mm are 0.13 wavelengths thick at 10 GHz");
  EXPECT_EQ(rcs({"--frequency-ghz", "10", "--azimuth-deg", "50", "--sheet-thickness-mm", "-1"}).code, 2);
}

TEST_F(RcsTarget, ACoatedPlateDropsByItsMaterial) {
  // Aluminium's surface resistance is 1e-4 of free space's: no measurable loss. The coating's |Gamma| is that of its
  // quarter-wave layer, about -11 dB at 16 GHz.
  const std::string library = SEAGLINT_SOURCE_DIR "/assets/materials/";
  const auto square = [&](const std::string& material) {
    const ProgramResult done = rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--material", material});
    EXPECT_EQ(done.code, 0) << done.err;
    return read_table(table()).rows.at(0).at(12);
  };
  const double metal = square("pec");
  EXPECT_NEAR(square(library + "aluminium.yaml"), metal, 0.01);
  EXPECT_NEAR(square(library + "ram_loaded_epoxy.yaml"), metal - 11.1, 0.5);
  EXPECT_NEAR(square("*=" + library + "ram_loaded_epoxy.yaml"), metal - 11.1, 0.5);
}

TEST_F(RcsTarget, RefusesUnknownMaterials) {
  const std::string library = SEAGLINT_SOURCE_DIR "/assets/materials/";
  const auto refused = [&](const std::string& ghz, const std::string& material) {
    const ProgramResult done = rcs({"--frequency-ghz", ghz, "--azimuth-deg", "0", "--material", material});
    EXPECT_EQ(done.code, 2);
    return done.err;
  };
  EXPECT_THAT(refused("16", "unobtainium"), HasSubstr("--material unobtainium: value 'unobtainium': no such material"));
  EXPECT_THAT(refused("16", "mast=pec"), HasSubstr("part 'mast': the mesh has no such part"));
  EXPECT_THAT(refused("36", library + "grp_sheet.yaml"), HasSubstr("its source covers 1 to 20 GHz"));
}

TEST_F(RcsTarget, APlateOnAConductingSeaIsADihedral) {
  // kWidthM high, its centre half of that above the water: image theory gives 2 A cos(el) / lambda, plus or minus the
  // direct lobe of the doubled plate, which is a sine over k kWidthM sin(el) = 50 at 30 deg, for two paths.
  const ProgramResult done = rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--elevation-deg", "30",
                                  "--sea-reflection", "--sea-surface", "conductor", "--origin-height-m", "0.15"});
  ASSERT_EQ(done.code, 0) << done.err;
  const auto row = read_table(table()).rows.at(0);
  const double lambda = kSpeedOfLight / 16e9, dihedral = 2 * kLengthM * kWidthM * std::cos(radians(30)) / lambda;
  const double level = 10 * std::log10(4 * kPi * dihedral * dihedral);
  EXPECT_NEAR(row.at(11), level, 20 * std::log10(1 + 1.0 / 50));
  EXPECT_NEAR(row.at(12), level, 20 * std::log10(1 + 1.0 / 50));
}

// kWidthM high about its middle: a table of zeros would suggest that it does not scatter.
TEST_F(RcsTarget, RefusesASubmergedTarget) {
  const ProgramResult done = rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--elevation-deg", "30",
                                  "--sea-reflection", "--origin-height-m", "-5"});
  EXPECT_EQ(done.code, 2);
  EXPECT_THAT(
      done.err,
      HasSubstr("--origin-height-m: value -5: must be greater than -0.15, else the whole target is under water\n"));
  EXPECT_EQ(rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--elevation-deg", "30", "--sea-reflection",
                 "--origin-height-m", "-0.14"})
                .code,
            0);
}

TEST_F(RcsTarget, RefusesASeaReflectionWithoutAnImage) {
  const ProgramResult done =
      rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--elevation-deg", "0", "--sea-reflection"});
  EXPECT_EQ(done.code, 2);
  EXPECT_THAT(done.err, HasSubstr("--elevation-deg: value 0: must be greater than 0 with --sea-reflection"));
  EXPECT_EQ(rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--origin-height-m", "3"}).code, 2);
  EXPECT_THAT(rcs({"--frequency-ghz", "94", "--azimuth-deg", "0", "--elevation-deg", "2", "--sea-reflection"}).err,
              HasSubstr("--frequency-ghz: value 94: must be at most 90"));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// `seaglint compare`: settings of other programs, a mesh in another unit, and values that are known.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "sim/core/process/file.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kReflector = "assets/icosahedral_reflector.glb";

class CompareSettings : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() / name; }

  ProgramResult run(const std::vector<std::string>& words) const {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 0) << result.err << result.out;
    return result;
  }
  ProgramResult compare(const std::string& name, const std::string& target,
                        const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"compare", path(name), "--target", target, "-o", path("compared")};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  nlohmann::json exports() const {
    return nlohmann::json::parse(read_file(path("compared") + "/compare.json"))["exports"];
  }
  void make(const std::vector<std::string>& words) const { run(words); }

  // Rows of a table without its head.
  static std::string rows(const std::string& file) {
    std::istringstream lines(read_file(file));
    std::string all;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("#")) all += line + "\n";
    }
    return all;
  }

  TemporaryFolder folder_;
};

TEST_F(CompareSettings, LikeIsTheOptionsOfItsTableAndGivenOnesTakePrecedence) {
  const auto table = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{"rcs",           "--target", kReflector, "--frequency-ghz", "10",
                                   "--azimuth-deg", "0:20:5",   "-o",       path(name)};
    words.insert(words.end(), more.begin(), more.end());
    run(words);
    return rows(path(name));
  };
  EXPECT_EQ(table("like.csv", {"--like", "hfss"}),
            table("given.csv", {"--crease-deg", "0", "--edges", "off", "--max-bounces", "3"}));
  EXPECT_THAT(read_file(path("like.csv")), HasSubstr("max_bounces 3, edges off, crease_deg 0"));
  EXPECT_THAT(read_file(path("like.csv")), HasSubstr(", like hfss\n"));
  EXPECT_EQ(table("like.csv", {"--like", "hfss", "--edges", "on", "--max-bounces", "40"}),
            table("given.csv", {"--crease-deg", "0"}));
  const ProgramResult refused = run_program({"rcs", "--target", kReflector, "--frequency-ghz", "10", "--azimuth-deg",
                                             "0", "-o", path("x.csv"), "--like", "xpatch"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--like"));
}

TEST_F(CompareSettings, TheTableAndThePageStateTheSettings) {
  run({"rcs", "--target", kReflector, "--frequency-ghz", "10", "--azimuth-deg", "0:10:5", "--like", "hfss", "-o",
       path("other.csv")});
  const ProgramResult result = compare("other.csv", kReflector, {"--like", "hfss", "--tolerance-db", "0.001"});
  const std::string settings = "seaglint solved with flat facets, no edge diffraction, at most 3 bounces, method beams";
  EXPECT_THAT(result.out, HasSubstr(settings + " (--like hfss)"));
  EXPECT_THAT(read_file(path("compared/compare.html")), HasSubstr(settings));
  EXPECT_EQ(exports()[0]["solver"]["like"], "hfss");
  EXPECT_EQ(exports()[0]["solver"]["max_bounces"], 3);
  EXPECT_TRUE(exports()[0]["trials"].empty());
  const ProgramResult refused = run_program(
      {"compare", path("other.csv"), "--against", path("other.csv"), "--like", "hfss", "-o", path("compared")});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--like is for --target"));
}

// A trihedral of 0.5 m whose file is in mm or in: the levels are those of 500 m until the unit is given.
TEST_F(CompareSettings, NamesTheUnitOfTheMesh) {
  make({"mesh", "make", "trihedral", "--leg-m", "0.5", "-o", path("metres.obj")});
  run({"rcs", "--target", path("metres.obj"), "--frequency-ghz", "9.5:10.5:0.5", "--azimuth-deg", "35:55:4",
       "--elevation-deg", "35", "-o", path("other.csv")});
  for (const auto& [unit, metres] : {std::pair{"mm", 1e-3}, {"in", 0.0254}, {"ft", 0.3048}}) {
    SCOPED_TRACE(unit);
    std::istringstream lines(read_file(path("metres.obj")));
    std::string scaled;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string kind;
      double x = 0, y = 0, z = 0;
      words >> kind >> x >> y >> z;
      scaled += kind == "v" ? fmt::format("v {:.9g} {:.9g} {:.9g}\n", x / metres, y / metres, z / metres) : line + "\n";
    }
    write_file(path("scaled.obj"), scaled);
    const ProgramResult result = compare("other.csv", path("scaled.obj"));
    EXPECT_THAT(result.out, HasSubstr(fmt::format("with --unit {} the median difference of 8 views falls from", unit)));
    EXPECT_THAT(result.out, HasSubstr(fmt::format(" to 0.0 dB: the mesh is in {}, not in m", unit)));
    EXPECT_EQ(exports()[0]["trials"][0]["option"], fmt::format("--unit {}", unit));
    EXPECT_TRUE(exports()[0]["known"].is_null()) << "the closed form of a trihedral of the wrong size";
    const ProgramResult right = compare("other.csv", path("scaled.obj"), {"--unit", unit});
    EXPECT_THAT(right.out, Not(HasSubstr("warning")));
  }
}

// A plate far from its normal: edge diffraction is most of its echo, which physical optics alone lacks.
TEST_F(CompareSettings, SolvesAFewViewsWithTheSettingsOfTheExportsProgram) {
  make({"mesh", "make", "plate", "--length-m", "0.3", "--width-m", "0.2", "-o", path("plate.obj")});
  run({"rcs", "--target", path("plate.obj"), "--frequency-ghz", "10", "--azimuth-deg", "60:85:0.5", "--edges", "off",
       "-o", path("other.csv"), "--export-as", "feko"});
  const ProgramResult result = compare("other_v.ffe", path("plate.obj"));
  EXPECT_THAT(result.out,
              HasSubstr("other_v.ffe: warning: with --like feko the median difference of 8 views falls from"));
  EXPECT_THAT(result.out, HasSubstr(" to 0.0 dB: flat facets"));
  EXPECT_TRUE(exports()[0]["trials"][0]["helps"].get<bool>());
  // An export that no setting explains.
  std::istringstream lines(rows(path("other.csv")));
  std::string noise = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,vv_dbsm\n";
  for (int n = 0; n <= 50; ++n) noise += fmt::format("1e10,{},0,{}\n", 60 + 0.5 * n, -15 + 7 * (n * n % 3));
  write_file(path("noise.csv"), noise);
  EXPECT_THAT(compare("noise.csv", path("plate.obj")).out, HasSubstr("dB, not less with --like hfss ("));
}

// The exact levels of a sphere (independent series, tests/reference/rcs/mie_sphere.csv) less 1.05 dB as the export.
TEST_F(CompareSettings, StatesTheExactValueOfASphere) {
  make({"mesh", "make", "sphere", "--radius-m", "0.3", "-o", path("sphere.obj")});
  std::istringstream lines(read_file(SEAGLINT_SOURCE_DIR "/tests/reference/rcs/mie_sphere.csv"));
  std::string csv = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,vv_dbsm\n", line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    double ka = 0, re = 0, im = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &ka, &re, &im), 3);
    if (ka > 110) continue;
    csv += fmt::format("{:.9g},0,0,{:.9g}\n", ka * 299792458.0 / (2 * std::numbers::pi * 0.3),
                       10 * std::log10(4 * std::numbers::pi * 0.09 * (re * re + im * im)) - 1.05);
  }
  write_file(path("other.csv"), csv);
  const ProgramResult result = compare("other.csv", path("sphere.obj"));
  EXPECT_THAT(result.out, HasSubstr("vv: exact (Mie series) of a sphere of radius 0.3 m, 3 places: export bias -1.05"));
  EXPECT_THAT(result.out, HasSubstr(": seaglint is closer"));
  const auto known = exports()[0]["known"];
  EXPECT_NEAR(known["export_bias_db"].get<double>(), -1.05, 1e-3);
  EXPECT_LT(std::abs(known["compared_bias_db"].get<double>()), 0.15);  // of the solver, CHANGELOG's table of spheres
  EXPECT_EQ(known["verdict"], "seaglint is closer");
  EXPECT_THAT(read_file(path("compared/compare.html")), HasSubstr("Against the known value"));
  EXPECT_THAT(read_file(path("compared/compare.csv")), HasSubstr("compared_im,known_dbsm\n"));
  const ProgramResult failed = run_program(
      {"compare", path("other.csv"), "--target", path("sphere.obj"), "--tolerance-db", "0.5", "-o", path("compared")});
  EXPECT_EQ(failed.code, 1);
  EXPECT_THAT(failed.err, HasSubstr("from the known value (exact (Mie series)) the export differs by 1.05 dB rms"));
}

// The sign of an element means something where both agree in it: hv here has unrelated phases, vv the opposite sign.
TEST_F(CompareSettings, NamesTheSignOfAnElementOnlyWhereBothAgree) {
  std::string here =
      "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,hv_re,hv_im,vv_re,vv_im\n";
  std::string other = here;
  for (int n = 0; n <= 40; ++n) {
    const double h = n * n, o = 7 * n * n + 3;
    here += fmt::format("{},0,0,3,0,{},{},2,0\n", 9e9 + 1e7 * n, 1e-2 * std::cos(h), 1e-2 * std::sin(h));
    other += fmt::format("{},0,0,3,0,{},{},-2,0\n", 9e9 + 1e7 * n, 1e-2 * (std::cos(o) - 0.3 * std::cos(h)),
                         1e-2 * (std::sin(o) - 0.3 * std::sin(h)));
  }
  write_file(path("here.csv"), here);
  write_file(path("other.csv"), other);
  const std::string out =
      run({"compare", path("other.csv"), "--against", path("here.csv"), "-o", path("compared")}).out;
  EXPECT_THAT(out, HasSubstr("vv of the export has the opposite sign"));
  EXPECT_THAT(out, Not(HasSubstr("hv of the export has the opposite sign")));
}

// hv and vh of two files that differ by 3 dB, as those of a solver with coarse rays; equal ones are not named.
TEST_F(CompareSettings, NamesCrossPolarLevelsThatViolateReciprocity) {
  const auto file = [&](const std::string& name, const std::string& column, double level) {
    std::string csv = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hh_dbsm," + column + "\n";
    for (int n = 0; n < 6; ++n) csv += fmt::format("1e10,{},0,0,{}\n", n, level + n);
    write_file(path(name), csv);
  };
  std::string both = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hv_dbsm,vh_dbsm\n";
  for (int n = 0; n < 6; ++n) both += fmt::format("1e10,{},0,-18,-18\n", n);
  write_file(path("both.csv"), both);
  file("hv.csv", "hv_dbsm", -20);
  file("vh.csv", "vh_dbsm", -17);
  const std::vector<std::string> words{"compare",        path("hv.csv"), path("vh.csv"),  "--against",
                                       path("both.csv"), "-o",           path("compared")};
  EXPECT_THAT(run(words).out, HasSubstr("vh.csv: warning: hv and vh of the export differ by 3.0 dB (median of 6"));
  file("hv.csv", "hv_dbsm", -17);
  EXPECT_THAT(run(words).out, Not(HasSubstr("reciprocity")));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "sim/core/numbers/random.h"
#include "sim/core/process/file.h"
#include "sim/field_tables/field_table.h"
#include "sim/scattering/observation/observation.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::Not;

// `seaglint compare`: what was put into a table of this program is found again, and files that cannot be compared are
// refused.

const std::string kReflector = "assets/icosahedral_reflector.glb";
const std::string kExports = "tests/cases/exports/";

class CompareCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() / name; }

  // The program's own table of the reflector at 21 frequencies, two elevations and 31 azimuths.
  FieldTable own_table() const {
    completed({"rcs", "--target", kReflector, "--frequency-ghz", "9.5:10.5:0.05", "--azimuth-deg", "0:15:0.5",
               "--elevation-deg", "2:5:3", "-o", path("own.csv")});
    return read_field_table(path("own.csv"), {});
  }

  nlohmann::json compared() const { return nlohmann::json::parse(read_file(path("compared") + "/compare.json")); }

  TemporaryFolder folder_;
};

// hh and vv of a table as a solver with other conventions would give them: 0.7 dB higher, about another origin, with a
// constant phase, e^{-jwt}, the sign of vv changed, with noise 30 dB below the mean power.
std::string disturbed(const FieldTable& table, const Vec3& origin, double phase) {
  std::string csv = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,vv_re,vv_im\n";
  const RcsCut& hh = table.cuts.at(0);
  const RcsCut& vv = table.cuts.at(3);
  double power = 0;
  for (std::size_t i = 0; i < hh.values.size(); ++i)
    power += 0.5 * (std::norm(*hh.values[i].amplitude_m) + std::norm(*vv.values[i].amplitude_m)) /
             static_cast<double>(hh.values.size());
  Random random({7, Stream::kTest, 0});
  for (std::size_t i = 0; i < hh.values.size(); ++i) {
    const FieldValue& value = hh.values[i];
    const double azimuth = value.phi_deg, elevation = 90 - value.theta_deg;
    const Vec3 q = 4 * std::numbers::pi * value.frequency_hz / 299792458.0 *
                   direction_to_radar(azimuth * std::numbers::pi / 180, elevation * std::numbers::pi / 180);
    const Complex turn = std::polar(std::pow(10.0, 0.7 / 20), phase - q.dot(origin));
    const auto other = [&](Complex s) {
      return std::conj(s * turn + std::sqrt(power * 1e-3 / 2) * Complex(random.normal(), random.normal()));
    };
    const Complex h = other(*value.amplitude_m), v = other(-*vv.values[i].amplitude_m);
    csv += fmt::format("{},{},{},{},{},{},{}\n", value.frequency_hz, azimuth, elevation, h.real(), h.imag(), v.real(),
                       v.imag());
  }
  return csv;
}

TEST_F(CompareCommand, FindsOffsetOriginTimeFactorAndSigns) {
  const Vec3 origin(0.31, -0.2, 0.05);
  write_file(path("other.csv"), disturbed(own_table(), origin, 0.6));
  const ProgramResult result =
      completed({"compare", path("other.csv"), "--target", kReflector, "-o", path("compared")});
  EXPECT_THAT(result.err, HasSubstr("other.csv: read as a table of seaglint rcs"));
  EXPECT_THAT(result.out, HasSubstr("other.csv: warning: the export has the other time factor, e^{-jwt}"));
  EXPECT_THAT(result.out, HasSubstr("other.csv: warning: vv of the export has the opposite sign"));
  EXPECT_THAT(result.out, HasSubstr("phase origin, or its mesh, is displaced: origin at 0.3"));
  EXPECT_THAT(result.out, HasSubstr("The RCS computed by seaglint is 0.7 dB lower than that of other.csv"));
  EXPECT_THAT(result.out, HasSubstr("phases included (correlation "));
  const nlohmann::json json = compared();
  ASSERT_EQ(json["exports"].size(), 2u);
  const double wavelength = 299792458.0 / 10.5e9;
  for (const auto& entry : json["exports"]) {
    const auto& fitted = entry["fitted"];
    EXPECT_EQ(entry["pairs"], 21 * 2 * 31);
    EXPECT_TRUE(fitted["conjugated"].get<bool>());
    EXPECT_EQ(fitted["sign"], entry["polarisation"] == "vv" ? -1 : 1);
    EXPECT_NEAR(fitted["offset_db"].get<double>(), 0.7, 0.05);
    // Over 15 deg of azimuth an error of the origin is nearly a constant phase: their sum in the middle of the data is
    // what they determine, to 0.1 deg by four standard errors of the noise (0.02 / sqrt(2604) rad each) and 0.1 deg by
    // the mean of the path gradients, which is not exactly that of the middle.
    const Vec3 fitted_origin(fitted["origin_m"][0], fitted["origin_m"][1], fitted["origin_m"][2]);
    const Vec3 middle = 4 * std::numbers::pi * 10e9 / 299792458.0 *
                        direction_to_radar(7.5 * std::numbers::pi / 180, 3.5 * std::numbers::pi / 180);
    EXPECT_NEAR(fitted["phase_deg"].get<double>() * std::numbers::pi / 180 - middle.dot(fitted_origin - origin), 0.6,
                0.2 * std::numbers::pi / 180);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(fitted["origin_m"][axis].get<double>(), origin[axis], wavelength / 50);
    EXPECT_THAT(fitted["undetermined"], testing::IsEmpty());
    EXPECT_GT(entry["correlation"].get<double>(), 0.998);
    EXPECT_NEAR(entry["bias_db"].get<double>(), -0.7, 0.1);
    EXPECT_EQ(entry["worst"].size(), 5u);
    EXPECT_THAT(entry["worst"][0]["main_contribution"].get<std::string>(), HasSubstr(" bounces, po, "));
  }
  // One row per pair below two lines of head, each with the line of the export.
  const std::string csv = read_file(path("compared") + "/compare.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2 + 2 * 21 * 2 * 31);
  EXPECT_THAT(csv, HasSubstr("other.csv,3,seaglint,hh,9.5e+09,0,2,"));
  EXPECT_GT(read_file(path("compared") + "/compare.png").size(), 10000u);
}

TEST_F(CompareCommand, OfAFileWithItselfFindsNoDifference) {
  const std::string file = kExports + "bistatic.ffe";
  completed({"compare", file, "--against", file, "--tolerance-db", "0.001", "--min-correlation", "0.9999", "-o",
             path("compared")});
  const nlohmann::json json = compared();
  for (const auto& entry : json["exports"]) {
    EXPECT_EQ(entry["pairs"], 12);
    EXPECT_NEAR(entry["correlation"].get<double>(), 1, 1e-12);
    EXPECT_EQ(entry["rms_db"], 0);
  }
}

// A table at other azimuths is interpolated on request; the reflector is within 0.6 m.
TEST_F(CompareCommand, InterpolatesOnRequest) {
  const auto table = [&](const std::string& name, const std::string& azimuths) {
    completed({"rcs", "--target", kReflector, "--frequency-ghz", "9.5:10.5:0.5", "--azimuth-deg", azimuths, "-o",
               path(name)});
  };
  table("fine.csv", "0:15:0.25");
  table("other.csv", "0.1:14:0.5");
  Words words{"compare", path("other.csv"), "--against", path("fine.csv"), "--as-is", "-o", path("compared")};
  expect_refused(words, "nothing is interpolated without --interpolate METRES");
  words.insert(words.end(), {"--interpolate", "0.6"});
  EXPECT_THAT(completed(words).out, HasSubstr("fine.csv: interpolated at "));
  const nlohmann::json json = compared();
  for (const auto& entry : json["exports"]) {
    EXPECT_EQ(entry["interpolation"]["omitted"], 0);
    EXPECT_EQ(entry["interpolation"]["radius_m"], 0.6);
    EXPECT_LT(entry["interpolation"]["standard_error"], 0.05);
    if (entry["polarisation"] == "vv" || entry["polarisation"] == "hh") {
      EXPECT_GT(entry["correlation"].get<double>(), 1 - 1e-3);
    }
  }
  words.back() = std::string("6");
  expect_refused(words, "needs steps below");
  expect_refused({"compare", path("other.csv"), "--target", kReflector, "--interpolate", "1", "-o", path("compared")},
                 "--interpolate is for --against");
}

// NumPy's file of a bistatic sweep has the values of the table.
TEST_F(CompareCommand, OpensTheSolvedValuesInNumPy) {
  if (run_words({kPython, "-c", "import numpy"}).code != 0) GTEST_SKIP() << "needs the package python3-numpy";
  completed({"rcs", "--target", kReflector, "--frequency-ghz", "9.5:10.5:0.5", "--azimuth-deg", "0:30:10",
             "--elevation-deg", "2:5:3", "--transmit-azimuth-deg", "40", "--transmit-elevation-deg", "-3", "-o",
             path("own.csv"), "--export-as", "npz"});
  completed(run_words({kPython, "-W", "error", "-c", R"(
import csv, json, numpy, sys
solved = numpy.load(sys.argv[1])
rows = list(csv.DictReader(line for line in open(sys.argv[2]) if not line.startswith('#')))
S = solved['S']
assert S.shape == (len(rows), 2, 2) and S.dtype == 'complex128', S.shape
assert set(solved['transmit_azimuth_deg']) == {40.0} and numpy.allclose(solved['transmit_elevation_deg'], -3, atol=1e-12)
places = {(f, a, round(e, 9)): s for f, a, e, s in
          zip(solved['frequency_hz'], solved['azimuth_deg'], solved['elevation_deg'], S)}
for row in rows:
    s = places[float(row['frequency_hz']), float(row['azimuth_deg']), float(row['elevation_deg'])]
    for p, received in enumerate('hv'):
        for q, transmitted in enumerate('hv'):
            pair = received + transmitted
            assert abs(s[p, q] - complex(float(row[pair + '_re']), float(row[pair + '_im']))) <= 2e-8 * abs(S).max(), pair
)",
                       path("own.npz"), path("own.csv")}));
}

// The solved values of a comparison, of two transmitters.
TEST_F(CompareCommand, WritesTheSolvedValuesForOtherPrograms) {
  const ProgramResult result = completed({"compare", kExports + "bistatic.ffe", "--target", kReflector, "--export-as",
                                          "feko", "--export-as", "npz", "-o", path("compared")});
  EXPECT_THAT(result.out, HasSubstr("solved.npz"));
  completed({"compare", path("compared/solved_v.ffe"), "--target", kReflector, "--as-is", "--tolerance-db", "0.001",
             "--min-correlation", "0.999999", "-o", path("again")});
  expect_refused({"compare", kExports + "bistatic.ffe", "--against", kExports + "bistatic.ffe", "--export-as", "npz",
                  "-o", path("compared")},
                 "--export-as is for --target");
}

// What `rcs` writes for other programs is read back as the same sweep.
TEST_F(CompareCommand, OfTheFilesForOtherProgramsFindsNoDifference) {
  completed({"rcs", "--target", kReflector, "--frequency-ghz", "9.5:10.5:0.5", "--azimuth-deg", "0:30:10",
             "--elevation-deg", "2:5:3", "-o", path("own.csv"), "--export-as", "feko", "--export-as", "cst"});
  for (const char* name : {"own_v.ffe", "own (f = 10), theta = (85,88,3), phi = (0,30,10), HP.txt"}) {
    SCOPED_TRACE(name);
    Words words{"compare",           path(name), "--against", path("own.csv"), "--as-is", "--tolerance-db", "0.001",
                "--min-correlation", "0.999999", "-o",        path("compared")};
    completed(words);
  }
  EXPECT_TRUE(std::filesystem::exists(path("own_h.ffe")));
}

TEST_F(CompareCommand, TakesSeveralExports) {
  const std::string head = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,";
  write_file(path("hh.csv"), head + "hh_dbsm\n1e10,0,0,3\n1e10,1,0,2\n");
  write_file(path("vv.csv"), head + "vv_dbsm\n1e10,0,0,5\n1e10,1,0,4\n");
  write_file(path("both.csv"), head + "hh_dbsm,vv_dbsm\n1e10,0,0,4,4\n1e10,1,0,3,3\n");
  completed({"compare", path("hh.csv"), path("vv.csv"), "--against", path("both.csv"), "-o", path("compared")});
  const nlohmann::json json = compared();
  ASSERT_EQ(json["exports"].size(), 2u);
  EXPECT_NEAR(json["exports"][0]["bias_db"], 1, 1e-9);
  EXPECT_NEAR(json["exports"][1]["bias_db"], -1, 1e-9);
}

TEST_F(CompareCommand, SuggestsWhatIsWrongWithLevels) {
  const std::string head = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hh_dbsm\n";
  std::string here = head, in_mm = head, doubled = head, mirrored = head;
  for (int az = -60; az <= 60; az += 2) {
    const double level = 10 * std::sin(0.11 * az) + 5 * std::cos(0.31 * az);
    here += fmt::format("1e10,{},0,{}\n", az, level);
    in_mm += fmt::format("1e10,{},0,{}\n", az, level + 60);
    doubled += fmt::format("1e10,{},0,{}\n", az, 2 * level);
    mirrored += fmt::format("1e10,{},0,{}\n", -az, level);
  }
  write_file(path("here.csv"), here);
  const auto warnings = [&](const std::string& text) {
    write_file(path("other.csv"), text);
    const ProgramResult result =
        completed({"compare", path("other.csv"), "--against", path("here.csv"), "-o", path("compared")});
    return result.out;
  };
  EXPECT_THAT(warnings(in_mm), HasSubstr("the export is 60.0 dB higher throughout: an area in mm^2 or a mesh in mm?"));
  EXPECT_THAT(warnings(doubled), HasSubstr("20 log of an area for 10 log?"));
  EXPECT_THAT(warnings(mirrored), HasSubstr("mirrored azimuths fit better: --reference-phi -1,0?"));
  EXPECT_THAT(warnings(here), Not(HasSubstr("warning")));
}

// Three points in a row along the line of sight, and the same 1.3 times as far apart.
TEST_F(CompareCommand, SuggestsAMeshOfAnotherSize) {
  const auto table = [](double scale) {
    std::string csv = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im\n";
    for (int n = 0; n <= 100; ++n) {
      const double f = 9e9 + 1e7 * n, k = 2 * std::numbers::pi * f / 299792458.0;
      Complex s = 0;
      for (const double x : {-2.0, 0.6, 3.1}) s += scale * std::polar(1.0, 2 * k * x * scale);
      csv += fmt::format("{},0,0,{},{}\n", f, s.real(), s.imag());
    }
    return csv;
  };
  write_file(path("here.csv"), table(1));
  write_file(path("other.csv"), table(1.3));
  EXPECT_THAT(
      completed({"compare", path("other.csv"), "--against", path("here.csv"), "--as-is", "-o", path("compared")}).out,
      HasSubstr("the export's mesh is 1.3"));
}

// A plate in its plane of symmetry has no cross-polar echo: what both have there is rounding, 0 and 1e-9 m.
TEST_F(CompareCommand, LeavesOutElementsThatAreRounding) {
  const auto table = [](double cross_m) {
    std::string csv = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hv_re,hv_im,vv_re,vv_im\n";
    for (int n = 0; n <= 10; ++n) csv += fmt::format("{},0,0,{},0,{},1\n", 9e9 + 1e7 * n, cross_m, 1 + 0.1 * n);
    return csv;
  };
  write_file(path("here.csv"), table(0));
  write_file(path("other.csv"), table(1e-9));
  const Words words{"compare", path("other.csv"), "--against", path("here.csv"), "-o", path("compared")};
  EXPECT_THAT(completed(words).out,
              HasSubstr("other.csv: hv is not compared: it is 120 dB or more below the strongest in both"));
  ASSERT_EQ(compared().at("exports").size(), 1u);
  EXPECT_EQ(compared().at("exports")[0].at("polarisation"), "vv");
  EXPECT_EQ(compared().at("not_compared")[0].at("name"), "other.csv");
}

// Zero on one side: the difference would be that of the floor, whatever the floor is. 1 to 2 m of vv, 1e-4 m of hv.
TEST_F(CompareCommand, LeavesOutElementsThatAreZeroOnOneSide) {
  const auto table = [](double cross_m) {
    std::string csv = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hv_re,hv_im,vv_re,vv_im\n";
    for (int n = 0; n <= 10; ++n) csv += fmt::format("{},0,0,{},0,{},0\n", 9e9 + 1e7 * n, cross_m, 1 + 0.1 * n);
    return csv;
  };
  write_file(path("zero.csv"), table(0));
  const auto compare = [&](const std::string& name, const std::string& against) {
    return run_program(
        {"compare", path(name), "--against", path(against), "--tolerance-db", "1", "-o", path("compared")});
  };
  write_file(path("small.csv"), table(1e-4));
  const ProgramResult small = completed(compare("small.csv", "zero.csv"));
  EXPECT_THAT(small.out, HasSubstr("small.csv: hv is not compared: 86.0 dB below the strongest in the export, zero in "
                                   "zero.csv"));
  ASSERT_EQ(compared().at("exports").size(), 1u);
  EXPECT_THAT(completed(compare("zero.csv", "small.csv")).out,
              HasSubstr("zero.csv: hv is not compared: zero in the export, 86.0 dB below the strongest in "
                        "small.csv"));
  // 26 dB below vv it is an echo that one of them lacks, which no tolerance covers.
  write_file(path("large.csv"), table(0.1));
  for (const auto& [name, against] : {std::pair("large.csv", "zero.csv"), std::pair("zero.csv", "large.csv")}) {
    const ProgramResult large = compare(name, against);
    EXPECT_EQ(large.code, 1) << large.out;
    EXPECT_THAT(large.out, HasSubstr("warning: hv is not compared: "));
    EXPECT_THAT(large.out, HasSubstr("26.0 dB below the strongest in "));
    EXPECT_THAT(large.err, HasSubstr("hv is not compared"));
    EXPECT_EQ(compared().at("exports").size(), 1u);
  }
  const std::string head = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,hv_dbsm\n";
  write_file(path("only.csv"), head + "9e9,0,0,-inf\n9.01e9,0,0,-inf\n");
  expect_refused({"compare", path("only.csv"), "--against", path("small.csv"), "-o", path("compared")},
                 "compare: nothing to compare:");
}

// The files of tests/cases/README.md: their values are those of a dihedral by this solver, in three decimals.
TEST_F(CompareCommand, ReadsUnitsTotalsAndChamberTablesOfADihedral) {
  const auto compare = [&](const std::string& file, const Words& more) {
    return completed({"compare", kExports + file, "--target", kExports + "dihedral.obj", "--tolerance-db", "0.001",
                      "-o", path("compared")},
                     more);
  };
  compare("hfss dBsm VP.csv", {});
  EXPECT_EQ(compared().at("exports")[0].at("polarisation"), "vv");
  const ProgramResult total = compare("hfss total VP.csv", {});
  EXPECT_THAT(total.out, HasSubstr("total_v"));
  EXPECT_THAT(total.out, HasSubstr("no phases"));
  EXPECT_EQ(compared().at("exports")[0].at("polarisation"), "total_v");
  EXPECT_EQ(compared().at("exports")[0].at("pairs"), 11);
  EXPECT_THAT(read_file(path("compared") + "/compare.csv"), HasSubstr("seaglint,total_v,6e+09,"));
  EXPECT_THAT(read_file(path("compared") + "/compare.html"), HasSubstr("total, v transmitted"));
  EXPECT_THAT(compare("chamber_hh_vv.csv", {"--reference-elevation-deg", "8", "--reference-frequency-ghz", "6"}).err,
              HasSubstr("elevation 8 deg as given"));
  EXPECT_EQ(compared().at("exports").size(), 2u);
}

// The page begins with the verdict that the command prints and compare.json has, and contains the images over azimuth
// and frequency.
TEST_F(CompareCommand, ThePageBeginsWithThePrintedVerdict) {
  own_table();
  const ProgramResult result =
      completed({"compare", path("own.csv"), "--target", kReflector, "--edges", "off", "-o", path("compared")});
  const std::string summary = compared()["exports"][0]["summary"];
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), summary);
  const std::string page = read_file(path("compared/compare.html"));
  EXPECT_THAT(page, HasSubstr("</h1>\n<p class=\"verdict\">" + summary + "</p>"));
  EXPECT_LT(page.find(summary), page.find("Largest differences"));
  EXPECT_THAT(page,
              HasSubstr("<th scope=\"col\">part</th><th scope=\"col\">bounces</th><th scope=\"col\">mechanism</th>"));
  EXPECT_THAT(page, HasSubstr("On a turntable"));
  for (const char* name : {"image_export.png", "image_compared.png", "image_difference.png", "turntable_export.png",
                           "turntable_compared.png", "profiles_export.png", "profiles_compared.png"})
    EXPECT_GT(read_file(path("compared") + "/" + name).size(), 1000u);
  EXPECT_LT(page.size(), 5'000'000u);
}

// A far field of FEKO does not state which polarisation was transmitted: v is assumed, h was.
TEST_F(CompareCommand, NamesTheOtherTransmittedPolarisation) {
  completed({"rcs", "--target", kReflector, "--frequency-ghz", "9.8:10.2:0.1", "--azimuth-deg", "10:20:2", "-o",
             path("own.csv"), "--export-as", "feko"});
  const Words words{"compare", path("own_h.ffe"), "--target", kReflector, "-o", path("compared")};
  EXPECT_THAT(completed(words).out,
              HasSubstr("Possible cause: with h transmitted instead of v the median difference falls from"));
  EXPECT_THAT(completed(words, {"--reference-polarisation", "h", "--tolerance-db", "0.01"}).out,
              HasSubstr("agrees with own_h.ffe within 0.01 dB"));
}

// A total against the elements that it is the sum of, and the other way round not.
TEST_F(CompareCommand, ComparesATotalWithTheSumOfBothElements) {
  write_file(path("total VP.csv"),
             "IWavePhi [deg],IWaveTheta [deg],Freq [GHz],MonostaticRCSTotal []\n0,90,10,5\n2,90,10,6\n");
  write_file(path("both VP.csv"),
             "IWavePhi [deg],IWaveTheta [deg],Freq [GHz],MonostaticRCSTheta [],MonostaticRCSPhi "
             "[]\n0,90,10,3,2\n2,90,10,1,5\n");
  completed({"compare", path("total VP.csv"), "--against", path("both VP.csv"), "--tolerance-db", "1e-6", "-o",
             path("compared")});
  EXPECT_EQ(compared().at("exports")[0].at("pairs"), 2);
  expect_refused({"compare", path("both VP.csv"), "--against", path("total VP.csv"), "-o", path("compared")},
                 "have no element");
}

TEST_F(CompareCommand, FailsBelowItsLimits) {
  const std::string file = kExports + "monostatic.ffe";
  const ProgramResult result =
      run_program({"compare", file, "--target", kReflector, "--tolerance-db", "0.5", "-o", path("compared")});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("monostatic.ffe vv: mean difference"));
  EXPECT_GT(read_file(path("compared") + "/compare.json").size(), 100u) << "the results are kept";
}

TEST_F(CompareCommand, RefusesWhatItCannotCompare) {
  const std::string out = path("compared");
  expect_refused({"compare", kExports + "monostatic.ffe", "-o", out}, "give either --target MESH or --against FILE");
  expect_refused(
      {"compare", kExports + "source.ffs", "--target", kReflector, "--reference-polarisation", "v", "-o", out},
      "source.ffs: neither the file nor its name says where the incident wave comes from: give --incidence "
      "monostatic or --incidence THETA,PHI");
  expect_refused({"compare", kExports + "source.ffs", "--target", kReflector, "-o", out},
                 "does not say which polarisation was transmitted");
  expect_refused({"compare", kExports + "monostatic.ffe", "--against", kExports + "bistatic.ffe", "-o", out},
                 "have no element, incident wave, direction and frequency in common");
  expect_refused({"compare", "README.md", "--target", kReflector, "-o", out},
                 "not a CST farfield source: no first line '// CST Farfield Source File'");
}

// `seaglint compare`: settings of other programs, a mesh in another unit, and values that are known.

class CompareSettings : public CompareCommand {
 protected:
  ProgramResult compare(const std::string& name, const std::string& target, const Words& more = {}) const {
    return completed({"compare", path(name), "--target", target, "-o", path("compared")}, more);
  }
  nlohmann::json exports() const { return compared()["exports"]; }

  // Rows of a table without its head.
  static std::string rows(const std::string& file) {
    std::istringstream lines(read_file(file));
    std::string all;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("#")) all += line + "\n";
    }
    return all;
  }
};

TEST_F(CompareSettings, LikeIsTheOptionsOfItsTableAndGivenOnesTakePrecedence) {
  const auto table = [&](const std::string& name, const Words& more) {
    completed({"rcs", "--target", kReflector, "--frequency-ghz", "10", "--azimuth-deg", "0:20:5", "-o", path(name)},
              more);
    return rows(path(name));
  };
  EXPECT_EQ(table("like.csv", {"--like", "hfss"}),
            table("given.csv", {"--crease-deg", "0", "--edges", "off", "--max-bounces", "3"}));
  EXPECT_THAT(read_file(path("like.csv")), HasSubstr("max_bounces 3, edges off, crease_deg 0"));
  EXPECT_THAT(read_file(path("like.csv")), HasSubstr(", like hfss\n"));
  EXPECT_EQ(table("like.csv", {"--like", "hfss", "--edges", "on", "--max-bounces", "40"}),
            table("given.csv", {"--crease-deg", "0"}));
  expect_refused({"rcs", "--target", kReflector, "--frequency-ghz", "10", "--azimuth-deg", "0", "-o", path("x.csv"),
                  "--like", "xpatch"},
                 "--like");
}

TEST_F(CompareSettings, TheTableAndThePageStateTheSettings) {
  completed({"rcs", "--target", kReflector, "--frequency-ghz", "10", "--azimuth-deg", "0:10:5", "--like", "hfss", "-o",
             path("other.csv")});
  const ProgramResult result = compare("other.csv", kReflector, {"--like", "hfss", "--tolerance-db", "0.001"});
  const std::string settings = "seaglint solved with flat facets, no edge diffraction, at most 3 bounces, method beams";
  EXPECT_THAT(result.out, HasSubstr(settings + " (--like hfss)"));
  EXPECT_THAT(read_file(path("compared/compare.html")), HasSubstr(settings));
  EXPECT_EQ(exports()[0]["solver"]["like"], "hfss");
  EXPECT_EQ(exports()[0]["solver"]["max_bounces"], 3);
  EXPECT_TRUE(exports()[0]["trials"].empty());
  expect_refused(
      {"compare", path("other.csv"), "--against", path("other.csv"), "--like", "hfss", "-o", path("compared")},
      "--like is for --target");
}

// A trihedral of 0.5 m whose file is in mm or in: the levels are those of 500 m until the unit is given.
TEST_F(CompareSettings, NamesTheUnitOfTheMesh) {
  completed({"mesh", "make", "trihedral", "--leg-m", "0.5", "-o", path("metres.obj")});
  completed({"rcs", "--target", path("metres.obj"), "--frequency-ghz", "9.5:10.5:0.5", "--azimuth-deg", "35:55:4",
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
    EXPECT_THAT(exports()[0]["summary"].get<std::string>(),
                HasSubstr(fmt::format(". With --unit {} the median", unit)));
    EXPECT_TRUE(exports()[0]["known"].is_null()) << "the closed form of a trihedral of the wrong size";
    EXPECT_THAT(compare("other.csv", path("scaled.obj"), {"--unit", unit}).out, Not(HasSubstr("warning")));
  }
}

// A plate far from its normal: edge diffraction is most of its echo, which physical optics alone lacks.
TEST_F(CompareSettings, SolvesAFewViewsWithTheSettingsOfTheExportsProgram) {
  completed({"mesh", "make", "plate", "--length-m", "0.3", "--width-m", "0.2", "-o", path("plate.obj")});
  completed({"rcs", "--target", path("plate.obj"), "--frequency-ghz", "10", "--azimuth-deg", "60:85:0.5", "--edges",
             "off", "-o", path("other.csv"), "--export-as", "feko"});
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
  completed({"mesh", "make", "sphere", "--radius-m", "0.3", "-o", path("sphere.obj")});
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
  EXPECT_THAT(result.out,
              testing::StartsWith("The RCS computed by seaglint is 1.0 dB higher than that of other.csv in vv;"));
  EXPECT_THAT(result.out,
              HasSubstr("From the exact value (Mie series) of the sphere of radius 0.3 m seaglint differs by 0.0"));
  EXPECT_THAT(result.out,
              HasSubstr("dB), the export by 1.05 dB (-1.05 dB): the difference is mainly the export's error.\n"));
  const auto known = exports()[0]["known"];
  EXPECT_NEAR(known["export_bias_db"].get<double>(), -1.05, 1e-3);
  EXPECT_LT(std::abs(known["compared_bias_db"].get<double>()), 0.15);  // of the solver for spheres (tests/accuracy.md)
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
      completed({"compare", path("other.csv"), "--against", path("here.csv"), "-o", path("compared")}).out;
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
  const Words words{"compare", path("hv.csv"), path("vh.csv"), "--against", path("both.csv"), "-o", path("compared")};
  EXPECT_THAT(completed(words).out,
              HasSubstr("vh.csv: warning: hv and vh of the export differ by 3.0 dB (median of 6"));
  file("hv.csv", "hv_dbsm", -17);
  EXPECT_THAT(completed(words).out, Not(HasSubstr("reciprocity")));
}

}  // namespace
}  // namespace seaglint

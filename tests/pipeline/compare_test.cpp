// SPDX-License-Identifier: BSD-3-Clause
// `seaglint compare`: what was put into a table of this program is found again, and files that cannot be compared are
// refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "sim/core/numbers/random.h"
#include "sim/core/process/file.h"
#include "sim/field_tables/read_field_table.h"
#include "sim/scattering/observation/observation.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

const std::string kReflector = "assets/icosahedral_reflector.glb";
const std::string kExports = "tests/cases/exports/";

void expect_refused(const std::vector<std::string>& arguments, const std::string& message) {
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.code, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr(message));
}

class CompareCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() / name; }

  // The program's own table of the reflector at 21 frequencies, two elevations and 31 azimuths.
  FieldTable own_table() const {
    const ProgramResult result =
        run_program({"rcs", "--target", kReflector, "--frequency-ghz", "9.5:10.5:0.05", "--azimuth-deg", "0:15:0.5",
                     "--elevation-deg", "2:5:3", "-o", path("own.csv")});
    EXPECT_EQ(result.code, 0) << result.err;
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
      run_program({"compare", path("other.csv"), "--target", kReflector, "-o", path("compared")});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("other.csv: read as a table of seaglint rcs"));
  EXPECT_THAT(result.out, HasSubstr("other.csv: warning: the export has the other time factor, e^{-jwt}"));
  EXPECT_THAT(result.out, HasSubstr("other.csv: warning: vv of the export has the opposite sign"));
  EXPECT_THAT(result.out, HasSubstr("phase origin, or its mesh, is displaced: origin at 0.3"));
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
  const ProgramResult result = run_program({"compare", file, "--against", file, "--tolerance-db", "0.001",
                                            "--min-correlation", "0.9999", "-o", path("compared")});
  EXPECT_EQ(result.code, 0) << result.err;
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
    const ProgramResult result = run_program({"rcs", "--target", kReflector, "--frequency-ghz", "9.5:10.5:0.5",
                                              "--azimuth-deg", azimuths, "-o", path(name)});
    ASSERT_EQ(result.code, 0) << result.err;
  };
  table("fine.csv", "0:15:0.25");
  table("other.csv", "0.1:14:0.5");
  std::vector<std::string> words{"compare", path("other.csv"), "--against", path("fine.csv"), "--as-is",
                                 "-o",      path("compared")};
  expect_refused(words, "nothing is interpolated without --interpolate METRES");
  words.insert(words.end(), {"--interpolate", "0.6"});
  const ProgramResult result = run_program(words);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("fine.csv: interpolated at "));
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
  ASSERT_EQ(run_program({"rcs", "--target", kReflector, "--frequency-ghz", "9.5:10.5:0.5", "--azimuth-deg", "0:30:10",
                         "--elevation-deg", "2:5:3", "--transmit-azimuth-deg", "40", "--transmit-elevation-deg", "-3",
                         "-o", path("own.csv"), "--export-as", "npz"})
                .code,
            0);
  const ProgramResult result = run_words({kPython, "-W", "error", "-c", R"(
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
                                          path("own.npz"), path("own.csv")});
  EXPECT_EQ(result.code, 0) << result.err;
}

// The solved values of a comparison, of two transmitters.
TEST_F(CompareCommand, WritesTheSolvedValuesForOtherPrograms) {
  const ProgramResult result = run_program({"compare", kExports + "bistatic.ffe", "--target", kReflector, "--export-as",
                                            "feko", "--export-as", "npz", "-o", path("compared")});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("solved.npz"));
  const ProgramResult again =
      run_program({"compare", path("compared/solved_v.ffe"), "--target", kReflector, "--as-is", "--tolerance-db",
                   "0.001", "--min-correlation", "0.999999", "-o", path("again")});
  EXPECT_EQ(again.code, 0) << again.err << again.out;
  expect_refused(
      {"compare", kExports + "bistatic.ffe", "--target", kReflector, "--export-as", "pyaedt", "-o", path("compared")},
      "--export-as pyaedt: these files hold monostatic values only");
  expect_refused({"compare", kExports + "bistatic.ffe", "--against", kExports + "bistatic.ffe", "--export-as", "npz",
                  "-o", path("compared")},
                 "--export-as is for --target");
}

// What `rcs` writes for other programs is read back as the same sweep.
TEST_F(CompareCommand, OfTheFilesForOtherProgramsFindsNoDifference) {
  ASSERT_EQ(run_program({"rcs", "--target", kReflector, "--frequency-ghz", "9.5:10.5:0.5", "--azimuth-deg", "0:30:10",
                         "--elevation-deg", "2:5:3", "-o", path("own.csv"), "--export-as", "feko", "--export-as", "cst",
                         "--export-as", "pyaedt"})
                .code,
            0);
  for (const char* name : {"own_v.ffe", "own VH.json", "own (f = 10), theta = (85,88,3), phi = (0,30,10), HP.txt"}) {
    SCOPED_TRACE(name);
    std::vector<std::string> words{"compare",        path(name), "--against",         path("own.csv"), "--as-is",
                                   "--tolerance-db", "0.001",    "--min-correlation", "0.999999",      "-o",
                                   path("compared")};
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 0) << result.err << result.out;
  }
  EXPECT_TRUE(std::filesystem::exists(path("own_h.ffe")));
}

TEST_F(CompareCommand, TakesSeveralExports) {
  const std::string head = "# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,";
  write_file(path("hh.csv"), head + "hh_dbsm\n1e10,0,0,3\n1e10,1,0,2\n");
  write_file(path("vv.csv"), head + "vv_dbsm\n1e10,0,0,5\n1e10,1,0,4\n");
  write_file(path("both.csv"), head + "hh_dbsm,vv_dbsm\n1e10,0,0,4,4\n1e10,1,0,3,3\n");
  const ProgramResult result =
      run_program({"compare", path("hh.csv"), path("vv.csv"), "--against", path("both.csv"), "-o", path("compared")});
  ASSERT_EQ(result.code, 0) << result.err;
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
        run_program({"compare", path("other.csv"), "--against", path("here.csv"), "-o", path("compared")});
    EXPECT_EQ(result.code, 0) << result.err;
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
  const ProgramResult result =
      run_program({"compare", path("other.csv"), "--against", path("here.csv"), "--as-is", "-o", path("compared")});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the export's mesh is 1.3"));
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
  const std::vector<std::string> words{"compare", path("other.csv"), "--against", path("here.csv"),
                                       "-o",      path("compared")};
  const ProgramResult result = run_program(words);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("other.csv: hv is not compared: it is 120 dB or more below the strongest in both"));
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
  const ProgramResult small = compare("small.csv", "zero.csv");
  EXPECT_EQ(small.code, 0) << small.err;
  EXPECT_THAT(small.out, HasSubstr("small.csv: hv is not compared: 86.0 dB below the strongest in the export, zero in "
                                   "zero.csv"));
  ASSERT_EQ(compared().at("exports").size(), 1u);
  const ProgramResult reversed = compare("zero.csv", "small.csv");
  EXPECT_EQ(reversed.code, 0) << reversed.err;
  EXPECT_THAT(reversed.out,
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
  const auto compare = [&](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> words{"compare",        kExports + file, "--target", kExports + "dihedral.obj",
                                   "--tolerance-db", "0.001",         "-o",       path("compared")};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 0) << result.err << result.out;
    return result;
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
  const ProgramResult chamber =
      compare("chamber_hh_vv.csv", {"--reference-elevation-deg", "8", "--reference-frequency-ghz", "6"});
  EXPECT_THAT(chamber.err, HasSubstr("elevation 8 deg as given"));
  EXPECT_EQ(compared().at("exports").size(), 2u);
}

// A total against the elements that it is the sum of, and the other way round not.
TEST_F(CompareCommand, ComparesATotalWithTheSumOfBothElements) {
  write_file(path("total VP.csv"),
             "IWavePhi [deg],IWaveTheta [deg],Freq [GHz],MonostaticRCSTotal []\n0,90,10,5\n2,90,10,6\n");
  write_file(path("both VP.csv"),
             "IWavePhi [deg],IWaveTheta [deg],Freq [GHz],MonostaticRCSTheta [],MonostaticRCSPhi "
             "[]\n0,90,10,3,2\n2,90,10,1,5\n");
  const ProgramResult result = run_program({"compare", path("total VP.csv"), "--against", path("both VP.csv"),
                                            "--tolerance-db", "1e-6", "-o", path("compared")});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(compared().at("exports")[0].at("pairs"), 2);
  expect_refused({"compare", path("both VP.csv"), "--against", path("total VP.csv"), "-o", path("compared")},
                 "have no element");
}

// A folder is all its exports, whose JSON names the geometry: neither a target nor a list of files is needed.
TEST_F(CompareCommand, TakesAFolderAndTheGeometryThatItsExportsName) {
  std::filesystem::create_directories(path("exports/geometry"));
  const std::string dihedral = read_file(std::string(SEAGLINT_SOURCE_DIR "/") + kExports + "dihedral.obj");
  const std::size_t faces = dihedral.find("f 1");
  write_file(path("exports/geometry/left.obj"), dihedral.substr(0, faces) + "f 1 2 3 4\n");
  write_file(path("exports/geometry/right.obj"), dihedral.substr(0, faces) + "f 5 1 4 6\n");
  const std::vector<std::string> sweep{"--frequency-ghz", "6", "--azimuth-deg", "-20:20:4", "--elevation-deg", "8"};
  std::vector<std::string> words{"rcs",         "--target", kExports + "dihedral.obj", "-o", path("exports/own.csv"),
                                 "--export-as", "pyaedt"};
  words.insert(words.end(), sweep.begin(), sweep.end());
  ASSERT_EQ(run_program(words).code, 0);
  std::filesystem::remove(path("exports/own.csv"));
  for (const char* element : {"HH", "HV", "VH", "VV"}) {
    const std::string file = path(std::string("exports/own ") + element + ".json");
    nlohmann::json json = nlohmann::json::parse(read_file(file));
    json["model_info"] = {{"left", {"left.obj", {143, 175, 143}, 1.0, "meter"}},
                          {"right", {"right.obj", {143, 0, 0}, 1.0, "meter"}}};
    write_file(file, json.dump());
  }
  write_file(path("exports/notes.txt"), "measured on a Monday\n");
  const ProgramResult one =
      run_program({"compare", path("exports/own VV.json"), "--tolerance-db", "0.001", "-o", path("compared")});
  EXPECT_EQ(one.code, 0) << one.err << one.out;
  EXPECT_THAT(one.err, HasSubstr("target as the export names it: "));
  const ProgramResult all = run_program({"compare", path("exports"), "--tolerance-db", "0.001", "-o", path("exports")});
  EXPECT_EQ(all.code, 0) << all.err << all.out;
  EXPECT_THAT(all.err, HasSubstr("exports: 4 tables; not read as tables: notes.txt, own HH.h5"));
  EXPECT_EQ(nlohmann::json::parse(read_file(path("exports/compare.json"))).at("exports").size(), 4u);
  // Its own results there are no exports.
  EXPECT_EQ(run_program({"compare", path("exports"), "-o", path("exports")}).code, 0);
  const ProgramResult parts =
      run_program({"compare", path("exports"), "--target", path("exports/geometry/left.obj"), "--target",
                   path("exports/geometry/right.obj"), "--tolerance-db", "0.001", "-o", path("compared")});
  EXPECT_EQ(parts.code, 0) << parts.err << parts.out;
  std::filesystem::remove(path("exports/geometry/left.obj"));
  expect_refused({"compare", path("exports/own VV.json"), "-o", path("compared")},
                 "own VV.json names no geometry that is beside it");
  expect_refused({"compare", path("exports/geometry"), "--target", kReflector, "-o", path("compared")},
                 "no file in this folder is a table");
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

}  // namespace
}  // namespace seaglint

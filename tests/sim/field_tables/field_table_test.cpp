// SPDX-License-Identifier: BSD-3-Clause
// Tables of the radar cross section of other programs.
#include "sim/field_tables/field_table.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <string>
#include <tuple>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

constexpr double kPrinted_db = 1e-9;  // rounding of logarithm and power

class FieldTableFile : public testing::Test {
 protected:
  RcsCut read(const std::string& name, const std::string& text, const FieldTableSettings& settings = {}) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return read_field_table(folder_ / name, settings).cuts.at(0);
  }
  std::string refusal(const std::string& name, const std::string& text, const FieldTableSettings& settings = {}) const {
    return refusal_of([&] { read(name, text, settings); });
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

FieldTableSettings as(Polarisation element, double frequency_ghz = 10) {
  FieldTableSettings settings;
  settings.elements = {element};
  settings.frequency_hz = frequency_ghz * 1e9;
  return settings;
}

// The header that `seaglint rcs` writes above its columns.
std::string own_table(const std::string& transmitter) {
  return "# seaglint 0.1.0 rcs\n# physical optics at every visible bounce, max_bounces 40, edges on, crease_deg 20, "
         "sheet_thickness_mm 0, wavefront_range_m 0 (0 = plane wave), min_patch_m 7e-05\n" +
         transmitter + "\nfrequency_hz,azimuth_deg,elevation_deg,vv_dbsm\n1e+10,3,4,-5\n";
}

// A table as CST 2020 writes it: names padded inside parentheses, units inside brackets, CRLF, theta fastest and
// through 0.
std::string cst_table(const std::string& unit, const std::string& rows) {
  return "Theta [deg.]  Phi   [deg.]  Abs(RCS )[" + unit + "]   Abs(Theta)[" + unit +
         "]  Phase(Theta)[deg.]  Abs(Phi  )[" + unit +
         "]  Phase(Phi  )[deg.]  Ax.Ratio[dB    ]    \r\n"
         "------------------------------------------------------------------------------------------\r\n" +
         rows;
}

TEST_F(FieldTableFile, OfFourColumnsTakesItsPolarisationFromTheName) {
  const std::string text = "5120000000.000000 90.000000 0.000000 8.073421 \n5120000000 90 -10.5 -667.1\n\n";
  const RcsCut h = read("ref_rcs.II.B.sx1.f10.H.txt", text);
  EXPECT_EQ(h.element, Polarisation::kHh);
  ASSERT_EQ(h.values.size(), 2u);
  EXPECT_EQ(h.values[0].level_dbsm, 8.073421);
  EXPECT_EQ(h.values[1].frequency_hz, 5.12e9);
  EXPECT_EQ(h.values[1].phi_deg, 349.5);
  EXPECT_EQ(h.values[1].level_dbsm, -667.1);
  EXPECT_FALSE(h.has_phase());
  EXPECT_EQ(read("ref.V.txt", text).element, Polarisation::kVv);
  EXPECT_EQ(read("ref.txt", text, as(Polarisation::kVv, 5.12)).element, Polarisation::kVv);
}

TEST_F(FieldTableFile, OfCstHasItsColumnsByNameAndItsUnitsByHeader) {
  // A received theta component of 4 m^2 at 30 deg, a phi component of 0.01 m^2 at 350 deg.
  const double level = 10 * std::log10(4.0);
  const auto row = [](double theta, double phi) {
    return "     90.000          180.000            6.02060e+00          " + std::to_string(theta) +
           "              30.000          " + std::to_string(phi) + "             350.000           2.684e+01     \r\n";
  };
  const std::string area = cst_table("m^2", row(4, 0.01));
  const RcsCut vv = read("farfield (f=10) [pw].txt", area, as(Polarisation::kVv));
  ASSERT_EQ(vv.values.size(), 1u);
  EXPECT_EQ(vv.values[0].frequency_hz, 10e9);
  EXPECT_EQ(vv.values[0].theta_deg, 90);
  EXPECT_EQ(vv.values[0].phi_deg, 180);
  EXPECT_NEAR(vv.values[0].level_dbsm, level, kPrinted_db);
  ASSERT_TRUE(vv.has_phase());
  // sigma = 4 pi |S|^2; theta^ = -v at both ends leaves the co-polar term as it is.
  EXPECT_LT(std::abs(*vv.values[0].amplitude_m - std::polar(std::sqrt(4 / (4 * kPi)), radians(30))), 1e-12);
  const RcsCut hh = read("a.txt", area, as(Polarisation::kHh));
  EXPECT_NEAR(hh.values[0].level_dbsm, -20, kPrinted_db);
  EXPECT_NEAR(degrees(std::arg(*hh.values[0].amplitude_m)), -10, 1e-9);
  // v transmitted as -theta^, h received as phi^: the cross-polar term changes sign.
  EXPECT_NEAR(degrees(std::arg(*read("a.txt", area, as(Polarisation::kHv)).values[0].amplitude_m)), 170, 1e-9);
  EXPECT_NEAR(degrees(std::arg(*read("a.txt", area, as(Polarisation::kVh)).values[0].amplitude_m)), -150, 1e-9);

  const double wavelength_db = 20 * std::log10(kSpeedOfLight / 10e9);
  for (const auto& [unit, theta, level_dbsm] : {std::tuple{"dB(m^2)", -3.5, -3.5},
                                                {"dBm^2 ", -3.5, -3.5},
                                                {"mm^2", 4e6, level},
                                                {"dB(mm^2)", 60.0, 0.0},
                                                {"dB(lambda^2)", 60.0, 60 + wavelength_db},
                                                {"m^2", 0.0, -1000.0}}) {
    const RcsCut cut = read("a.txt", cst_table(unit, row(theta, 0)), as(Polarisation::kVv));
    EXPECT_NEAR(cut.values[0].level_dbsm, level_dbsm, kPrinted_db) << unit;
  }
}

TEST_F(FieldTableFile, OfCstWithNegativeThetaIsFoldedAndChangesSign) {
  // decimal commas of another locale
  const std::string row = " -30,000  90,000  0,000e+00  0,000e+00  10,000  0,000e+00  20,000  0,000e+00\r\n";
  const RcsCut vv = read("a.txt", cst_table("dB(m^2)", row), as(Polarisation::kVv));
  EXPECT_EQ(vv.values[0].theta_deg, 30);
  EXPECT_EQ(vv.values[0].phi_deg, 270);
  EXPECT_NEAR(degrees(std::arg(*vv.values[0].amplitude_m)), 10 - 180, 1e-9);
}

TEST_F(FieldTableFile, OfAFullCircleIsFoldedAtBothPoles) {
  const RcsCut circle = read("a.H.txt", "1e10 190 20 -3\n1e10 -170 20 -3\n1e10 370 20 -4\n");
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(circle.values[i].theta_deg, 170);
    EXPECT_EQ(circle.values[i].phi_deg, 200);
  }
  EXPECT_EQ(circle.values[2].theta_deg, 10);
  EXPECT_EQ(circle.values[2].phi_deg, 20);
  const RcsCut cst =
      read("a.txt", cst_table("dB(m^2)", "190 20 0 0 30 0 0 0\r\n170 200 0 0 30 0 0 0\r\n"), as(Polarisation::kVv));
  EXPECT_LT(std::abs(*cst.values[0].amplitude_m + *cst.values[1].amplitude_m), kPrinted_db);
}

TEST_F(FieldTableFile, MayHaveAHeaderAndExactZeros) {
  const RcsCut reference = read("a.V.txt", "# frequency_hz theta_deg phi_deg dBsm\n1e10 90 0 -inf\n1e10 90 1 -3\n");
  ASSERT_EQ(reference.values.size(), 2u);
  EXPECT_LT(reference.values[0].level_dbsm, -300);
  EXPECT_HAS(refusal("b.V.txt", "1e10 90 0 low\n"),
             "b.V.txt:1:11: dbsm: value 'low': must be a finite number (read as four columns)");
}

TEST_F(FieldTableFile, OfThisProgramIsReadByItsColumnsNames) {
  const std::string text =
      "# seaglint\nfrequency_hz,azimuth_deg,elevation_deg,vv_re,vv_im,hh_dbsm\n1e10,-20,2,0.3,-0.4,-7\n";
  const RcsCut vv = read("own.csv", text, as(Polarisation::kVv));
  ASSERT_EQ(vv.values.size(), 1u);
  EXPECT_EQ(vv.values[0].theta_deg, 88);
  EXPECT_EQ(vv.values[0].phi_deg, 340);
  EXPECT_EQ(*vv.values[0].amplitude_m, Complex(0.3, -0.4));
  EXPECT_NEAR(vv.values[0].level_dbsm, 10 * std::log10(kPi), kPrinted_db);  // 4 pi 0.25
  const RcsCut hh = read("own.csv", text, as(Polarisation::kHh));
  EXPECT_EQ(hh.values[0].level_dbsm, -7);
  EXPECT_FALSE(hh.has_phase());
}

TEST_F(FieldTableFile, ThatCannotBeUsedIsRefusedWithItsPlace) {
  EXPECT_HAS(refusal("a.txt", "1e9 90 0 1\n"), "--reference-polarisation");
  EXPECT_HAS(refusal("a.H.txt", "1e9 90 0 1\n1e9 90 0.5\n"), "a.H.txt:2:1: 3 cells where the names are 4");
  EXPECT_HAS(refusal("a.H.txt", "1e9 90 0 1\n1e9 90 0.5 nan\n"), "a.H.txt:2:12: dbsm: value 'nan'");
  EXPECT_HAS(refusal("a.H.txt", "0 90 0 1\n"), "a.H.txt:1:1: frequency_hz: value '0': must be greater than 0");
  EXPECT_HAS(refusal("a.H.txt", "a report\n"), "not a table of the radar cross section");
  EXPECT_HAS(refusal("a.H.txt", ""), "not a table of the radar cross section");
  EXPECT_HAS(refusal("a.H.ffs", "// CST Farfield Source File\n"), ".ffs");
  const std::string row = "90 0 1 1 0 1 0 1\r\n";
  FieldTableSettings no_frequency;
  no_frequency.elements = {Polarisation::kVv};
  EXPECT_HAS(refusal("a.txt", cst_table("m^2", row), no_frequency), "--reference-frequency-ghz");
  EXPECT_HAS(refusal("a.txt", cst_table("dB    ", row), as(Polarisation::kVv)), "relative to its own maximum");
  EXPECT_HAS(refusal("a.txt", cst_table("A/m", row), as(Polarisation::kVv)), "[A/m]: the unit must be");
  EXPECT_HAS(refusal("a.txt", cst_table("m^2", "90 0 1\r\n"), as(Polarisation::kVv)),
             "a.txt:3:1: 3 cells where the names are 8");
  EXPECT_HAS(refusal("a.txt", cst_table("m^2", ""), as(Polarisation::kVv)), "contains no values");
  EXPECT_HAS(refusal("own.csv", "frequency_hz,azimuth_deg,elevation_deg,vv_re\n", as(Polarisation::kHh)), "hh_dbsm");
}

TEST_F(FieldTableFile, IsReadAsOtherSystemsWriteIt) {
  const fs::path cases = SEAGLINT_SOURCE_DIR "/tests/cases/tables";
  const RcsCut marked = read_field_table(cases / "four_columns_bom.H.txt", {}).cuts.at(0);
  ASSERT_GT(marked.values.size(), 20u);
  EXPECT_EQ(marked.values[0].frequency_hz, 6e9);
  EXPECT_EQ(marked.values[0].level_dbsm, 12.223);
  const RcsCut cst = read_field_table(cases / "cst_with_hash_line.txt", as(Polarisation::kHh, 6)).cuts.at(0);
  ASSERT_GT(cst.values.size(), 10u);
  EXPECT_EQ(cst.values[0].theta_deg, 83);
  EXPECT_EQ(cst.values[0].level_dbsm, 12.22);
  for (const char* text : {"1e10,90,0,-3.5\n1e10,90,1,-4\n", "1e10;90;0;-3,5\r\n1e10;90;1;-4\r\n",
                           "10000000000 90,0 0 -3,5\n1e10 90 1 -4\n",
                           "frequency_hz theta_deg phi_deg dBsm\n1e10 90 0 -3.5\n1e10 90 1 -4\n",
                           "Frequency [GHz];Phi [deg];Theta [deg];RCS [dBsm]\n10;0;90;-3,5\n10;1;90;-4\n"}) {
    SCOPED_TRACE(text);
    const RcsCut four = read("a.V.txt", text);
    ASSERT_EQ(four.values.size(), 2u);
    EXPECT_EQ(four.values[0].frequency_hz, 1e10);
    EXPECT_EQ(four.values[0].theta_deg, 90);
    EXPECT_EQ(four.values[0].level_dbsm, -3.5);
    EXPECT_EQ(four.values[1].phi_deg, 1);
  }
  const RcsCut own = read(
      "own.csv",
      "\xef\xbb\xbf# transmitter=monostatic\r\nfrequency_hz;azimuth_deg;elevation_deg;hh_dbsm\r\n1e10;0,5;2;-7,25\r\n",
      as(Polarisation::kHh));
  EXPECT_EQ(own.values[0].phi_deg, 0.5);
  EXPECT_EQ(own.values[0].level_dbsm, -7.25);
  EXPECT_TRUE(own.transmitter);
}

TEST_F(FieldTableFile, WithAColumnTwiceOrAFrequencyOfZeroIsRefused) {
  const auto complaint = [](const char* name) {
    return refusal_of([&] { read_field_table(fs::path(SEAGLINT_SOURCE_DIR "/tests/cases/tables") / name, {}); });
  };
  EXPECT_HAS(complaint("duplicate_column.H.csv"),
             "column hh_re appears twice: columns 4 and 6 of the table (read as a table of seaglint rcs)");
  EXPECT_HAS(complaint("frequency_zero.H.csv"),
             "frequency_zero.H.csv:3:1: frequency_hz: value '0': must be greater than 0");
}

TEST_F(FieldTableFile, HasTheDirectionOfItsTransmitter) {
  const RcsCut monostatic = read("m.csv", own_table("# transmitter=monostatic"), as(Polarisation::kVv));
  ASSERT_TRUE(monostatic.transmitter);
  EXPECT_TRUE(monostatic.transmitter->is_monostatic);
  const RcsCut bistatic =
      read("b.csv", own_table("# transmitter_azimuth_deg=-20 transmitter_elevation_deg=30.5"), as(Polarisation::kVv));
  ASSERT_TRUE(bistatic.transmitter);
  EXPECT_FALSE(bistatic.transmitter->is_monostatic);
  EXPECT_EQ(bistatic.transmitter->phi_deg, 340);
  EXPECT_EQ(bistatic.transmitter->theta_deg, 59.5);
  EXPECT_FALSE(read("a.V.txt", "10e9 90 0 -3\n").transmitter);
  EXPECT_FALSE(read("c.csv", "frequency_hz,azimuth_deg,elevation_deg,vv_dbsm\n1e+10,3,4,-5\n", as(Polarisation::kVv))
                   .transmitter);
}

TEST_F(FieldTableFile, IsRefusedWhereItsHeadDoesNotStateTheTransmitter) {
  const auto refused = [&](const std::string& line) {
    return refusal("d.csv", own_table(line), as(Polarisation::kVv));
  };
  EXPECT_HAS(refused("# plane wave, transmitter at azimuth -20 deg, elevation 30.5 deg"),
             "d.csv: its head does not state the transmitter: add the line '# transmitter=monostatic', or "
             "'# transmitter_azimuth_deg=0 transmitter_elevation_deg=0' with its angles");
  EXPECT_HAS(refused("# transmitter_azimuth_deg=3"), "d.csv:3:1: the key transmitter_elevation_deg is missing");
  EXPECT_HAS(refused("# transmitter_azimuth_deg=3 transmitter_elevation_deg=x"),
             "d.csv:3:1: transmitter_elevation_deg=x: must be a number");
  EXPECT_HAS(refused("# transmitter=fixed"), "d.csv:3:1: transmitter=fixed: must be transmitter=monostatic or");
  EXPECT_HAS(refused("# transmitter=monostatic (backscatter)"),
             "d.csv:3:1: '(backscatter)': no key of the transmitter");
}

TEST_F(FieldTableFile, IsRefusedWithAFrequencyThatIsNotItsOwn) {
  EXPECT_HAS(refusal("a.V.txt", "10e9 90 0 -3\n", as(Polarisation::kVv, 11)),
             "a.V.txt: declares 10 GHz: remove --reference-frequency-ghz 11");
  EXPECT_HAS(refusal("own.csv", own_table("# transmitter=monostatic"), as(Polarisation::kVv, 11)),
             "own.csv: declares 10 GHz");
  EXPECT_EQ(read("b.V.txt", "10e9 90 0 -3\n", as(Polarisation::kVv, 10)).values.size(), 1u);
}

// A monostatic row of HFSS whose columns of values are `names`.
std::string hfss_table(const std::string& names, const std::string& values) {
  return "\"IWavePhi [deg]\",\"IWaveTheta [deg]\",\"Freq [GHz]\"," + names + "\n20,80,10," + values + "\n";
}

TEST_F(FieldTableFile, OfHfssIsReadInTheUnitsOfItsColumns) {
  const auto level = [&](const std::string& names, const std::string& values) {
    return read("a.csv", hfss_table(names, values), as(Polarisation::kVv)).values.at(0).level_dbsm;
  };
  const double wanted = 10 * std::log10(2.0);  // of 2 m^2
  const std::pair<const char*, const char*> areas[] = {{"[]", "2"},
                                                       {"", "2"},
                                                       {"[m^2]", "2"},
                                                       {"[m2]", "2"},
                                                       {"[meter2]", "2"},
                                                       {"[meter^2]", "2"},
                                                       {"[mm^2]", "2e6"},
                                                       {"[mm2]", "2e6"},
                                                       {"[cm^2]", "2e4"},
                                                       {"[cm2]", "2e4"},
                                                       {"[dBsm]", "3.010299956639812"},
                                                       {"[dB(m^2)]", "3.010299956639812"},
                                                       {"[dB]", "3.010299956639812"},
                                                       {"[ dBsm ]", "3.010299956639812"}};
  for (const auto& [unit, value] : areas) {
    EXPECT_NEAR(level(std::string("\"MonostaticRCSTheta ") + unit + "\"", value), wanted, kPrinted_db) << unit;
    EXPECT_NEAR(level(std::string("\"mag(MonostaticRCSTheta) ") + unit + "\"", value), wanted, kPrinted_db) << unit;
  }
  for (const char* name : {"dB(MonostaticRCSTheta) []", "dB10(MonostaticRCSTheta) [dB]",
                           "dB(MonostaticRCSTheta) [dBsm]", "dB20(ComplexMonostaticRCSTheta) []"})
    EXPECT_NEAR(level(name, "3.010299956639812"), wanted, kPrinted_db) << name;
  EXPECT_NEAR(level("mag(ComplexMonostaticRCSTheta) [mm]", "1414.2135623730951"), wanted, kPrinted_db);
}

TEST_F(FieldTableFile, OfHfssHasComplexValuesInUnitsOfLength) {
  const Complex wanted = std::polar(1 / std::sqrt(4 * kPi), kPi / 3);  // of 1 m^2
  const std::pair<const char*, const char*> tables[] = {
      {"re(ComplexMonostaticRCSTheta) [mm],im(ComplexMonostaticRCSTheta) [mm]", "500,866.0254037844386"},
      {"re(ComplexMonostaticRCSTheta) [cm],im(ComplexMonostaticRCSTheta) [meter]", "50,0.8660254037844386"},
      {"mag(ComplexMonostaticRCSTheta) [mm],ang_deg(ComplexMonostaticRCSTheta) [deg]", "1000,60"},
      {"dB(ComplexMonostaticRCSTheta) [],cang_rad(ComplexMonostaticRCSTheta) []", "0,1.0471975511965976"}};
  for (const auto& [names, values] : tables) {
    const FieldValue value = read("a.csv", hfss_table(names, values), as(Polarisation::kVv)).values.at(0);
    ASSERT_TRUE(value.amplitude_m) << names;
    EXPECT_LT(std::abs(*value.amplitude_m - wanted), 1e-12) << names;
    EXPECT_NEAR(value.level_dbsm, 0, kPrinted_db) << names;
  }
}

TEST_F(FieldTableFile, OfHfssHasAnglesAndFrequenciesInTheirUnits) {
  const RcsCut cut = read("a.csv",
                          "IWavePhi [rad],IWaveTheta [rad],Freq [MHz],MonostaticRCSTheta [mm^2]\n"
                          "0.7853981633974483,1.5707963267948966,9500,1e6\n",
                          as(Polarisation::kVv, 9.5));
  EXPECT_NEAR(cut.values.at(0).phi_deg, 45, 1e-12);
  EXPECT_NEAR(cut.values.at(0).theta_deg, 90, 1e-12);
  EXPECT_EQ(cut.values.at(0).frequency_hz, 9.5e9);
  const RcsCut family =
      read("b.csv",
           "IWavePhi [deg],\"MonostaticRCSTheta [mm^2] - Freq='9500MHz' IWaveTheta='1.5707963267948966rad'\"\n"
           "3,1e6\n",
           as(Polarisation::kVv, 9.5));
  EXPECT_NEAR(family.values.at(0).theta_deg, 90, 1e-12);
  EXPECT_NEAR(family.values.at(0).level_dbsm, 0, kPrinted_db);
}

TEST_F(FieldTableFile, OfHfssIsRefusedInAnotherUnitWithItsName) {
  const auto refused = [&](const std::string& names) {
    return refusal("a.csv", hfss_table(names, "1,2"), as(Polarisation::kVv));
  };
  const auto with = [](const char* name) { return std::string(name) + ",x []"; };
  for (const char* unit : {"dBm", "A/m", "V/m", "lambda^2", "acre", "m"}) {
    const std::string text = refused(with(fmt::format("MonostaticRCSTheta [{}]", unit).c_str()));
    EXPECT_HAS(text, "a.csv:1:");
    EXPECT_HAS(text, unit);
    EXPECT_HAS(text, "MonostaticRCSTheta");
  }
  EXPECT_HAS(refused(with("dB(MonostaticRCSTheta) [mm^2]")), "unit 'mm^2' of dB(MonostaticRCSTheta)");
  EXPECT_HAS(refused("re(ComplexMonostaticRCSTheta) [m^2],im(ComplexMonostaticRCSTheta) [m^2]"),
             "unit 'm^2' of re(ComplexMonostaticRCSTheta)");
  EXPECT_HAS(refusal("a.csv", "IWavePhi [grad],IWaveTheta [deg],MonostaticRCSTheta []\n1,2,3\n", as(Polarisation::kVv)),
             "IWavePhi [grad]: must be in [deg] or [rad]");
  EXPECT_HAS(refusal("a.csv", "IWavePhi [deg],IWaveTheta [deg],Freq [rpm],MonostaticRCSTheta []\n1,2,3,4\n",
                     as(Polarisation::kVv)),
             "Freq [rpm]: must be in [GHz]");
}

TEST_F(FieldTableFile, OfHfssHasNoAreasInFunctionsThatAreNone) {
  for (const char* name :
       {"ang_deg(MonostaticRCSTheta) [deg]", "re(MonostaticRCSTheta) []", "dB10normalize(MonostaticRCSTheta) []",
        "dB20(MonostaticRCSTheta) []", "ComplexMonostaticRCSTheta []"}) {
    EXPECT_HAS(refusal("a.csv", hfss_table(name, "1"), as(Polarisation::kVv)), std::string("not read: ") + name);
  }
}

FieldTableSettings transmitting_v(double frequency_ghz = 10) {
  FieldTableSettings settings = as(Polarisation::kVv, frequency_ghz);
  settings.elements.push_back(Polarisation::kHv);
  return settings;
}

TEST_F(FieldTableFile, OfATotalIsThatOfTheTransmittedPolarisation) {
  const std::pair<const char*, std::string> files[] = {
      {"a.csv", hfss_table("dB(MonostaticRCSTotal) []", "6")},
      {"b.csv",
       "IWavePhi [deg],IWaveTheta [deg],Phi [deg],Theta [deg],Freq [GHz],BistaticRCSTotal [dBsm]\n0,90,20,80,10,6\n"},
      {"c.txt", "Theta [deg.]  Phi [deg.]  Abs(RCS )[dB(m^2)]\n-----\n80 20 6\n"},
      {"theta=80 phi=20 dBsm.txt", "#\"Frequency / GHz\"\t\"RCS_Abs [Magnitude]\"\n#-----\n10\t6\n"}};
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    const RcsCut cut = read(name, text, transmitting_v());
    EXPECT_TRUE(cut.total);
    EXPECT_EQ(cut.quantity(), 5u);
    EXPECT_FALSE(cut.has_phase());
    ASSERT_EQ(cut.values.size(), 1u);
    EXPECT_NEAR(cut.values[0].level_dbsm, 6, kPrinted_db);
    EXPECT_EQ(cut.values[0].theta_deg, 80);
    EXPECT_EQ(cut.values[0].phi_deg, 20);
  }
  EXPECT_EQ(read("d VP.csv", files[0].second).quantity(), 5u);
  EXPECT_EQ(read("d HP.csv", files[0].second).quantity(), 4u);
  EXPECT_HAS(refusal("e.csv", files[0].second), "give --reference-polarisation h or v");
  EXPECT_HAS(refusal("e.csv", files[0].second, as(Polarisation::kVv)),
             "the sum over both received polarisations: give --reference-polarisation h or v");
  // Components are more than their sum.
  EXPECT_FALSE(read("f VP.csv", hfss_table("dB(MonostaticRCSTheta) [],dB(MonostaticRCSTotal) []", "5,6")).total);
}

TEST_F(FieldTableFile, OfABistaticHfssReportHasItsIncidentWave) {
  std::ofstream(folder_ / "b VP.csv")
      << "Phi [deg],Theta [deg],\"dB(BistaticRCSTheta) [] - Freq='10GHz' IWavePhi='0deg' "
         "IWaveTheta='90deg'\",\"dB(BistaticRCSTheta) [] - Freq='10GHz' IWavePhi='30deg' "
         "IWaveTheta='90deg'\"\n20,80,1,2\n40,80,3,4\n";
  const FieldTable table = read_field_table(folder_ / "b VP.csv", {});
  ASSERT_EQ(table.cuts.size(), 2u);
  EXPECT_EQ(table.cuts[1].transmitter->phi_deg, 30);
  EXPECT_FALSE(table.cuts[1].transmitter->is_monostatic);
  EXPECT_EQ(table.cuts[1].values.at(1).phi_deg, 40);
  EXPECT_EQ(table.cuts[1].values.at(1).level_dbsm, 4);
}

TEST_F(FieldTableFile, ByAzimuthIsReadAsChambersWriteIt) {
  FieldTableSettings settings;
  settings.frequency_hz = 6e9;
  settings.elevation_deg = 8;
  for (const char* text :
       {"Azimuth (deg),HH (dBsm),VV (dBsm)\n-20,-2.5,3.25\n-16,-1,4\n",
        "AZ_deg;hh_dBsm;vv_dBsm\n-20;-2,5;3,25\n-16;-1;4\n",
        "Azimuth (\xc2\xb0),HH (dBsm),VV (dBsm)\n-20,-2.5,3.25\n-16,-1,4\n",
        "azimuth[deg] HH[dBsm] VV[dBsm]\n-20 -2.5 3.25\n-16 -1 4\n",
        "Azimuth\tHH\tVV\n(deg)\t(dBsm)\t(dBsm)\n-20\t-2.5\t3.25\n-16\t-1\t4\n",
        "# azimuth_deg hh_dbsm vv_dbsm\n-20 -2.5 3.25\n-16 -1 4\n",
        "Angle [degrees],RCS_HH [dBsm],RCS_VV [dBsm]\n-20,-2.5,3.25\n-16,-1,4\n",
        "Azimuth (deg),Frequency (MHz),Elevation (deg),HH (dBsm),VV (dBm^2)\n-20,6000,8,-2.5,3.25\n-16,6000,8,-1,4\n",
        "azimuth_rad,VV (m^2),HH "
        "(m^2)\n-0.3490658503988659,2.1134890398366464,0.5623413251903491\n-0.2792526803190927,2.51188643,0."
        "79432823\n"}) {
    SCOPED_TRACE(text);
    std::ofstream(folder_ / "chamber.csv", std::ios::binary) << text;
    const FieldTable table = read_field_table(folder_ / "chamber.csv", settings);
    ASSERT_EQ(table.cuts.size(), 2u);
    for (const RcsCut& cut : table.cuts) {
      EXPECT_TRUE(cut.transmitter && cut.transmitter->is_monostatic);
      ASSERT_EQ(cut.values.size(), 2u);
      EXPECT_EQ(cut.values[0].frequency_hz, 6e9);
      EXPECT_NEAR(cut.values[0].theta_deg, 82, 1e-9);
      EXPECT_NEAR(cut.values[0].phi_deg, 340, 1e-9);
      EXPECT_NEAR(cut.values[0].level_dbsm, cut.element == Polarisation::kHh ? -2.5 : 3.25, 1e-8);
      EXPECT_FALSE(cut.has_phase());
    }
  }
}

// Sentences about an azimuth are no names of columns.
TEST_F(FieldTableFile, OfFourColumnsMayHaveSentencesAboveThem) {
  for (const char* above : {"# azimuth cut, rcs of the plate in dBsm\n", "azimuth cut of the rcs\n", "# az HH\n"}) {
    const RcsCut cut = read("a.V.txt", std::string(above) + "1e10 90 0 -3\n1e10 90 1 -4\n");
    ASSERT_EQ(cut.values.size(), 2u) << above;
    EXPECT_EQ(cut.values[1].phi_deg, 1);
  }
}

TEST_F(FieldTableFile, ByAzimuthMayHavePhasesFrequenciesAndOneElement) {
  const RcsCut hv =
      read("a.csv", "Freq (GHz),Azimuth (deg),HH (dBsm),HH phase (deg),HV (dBsm),Phase HV (deg)\n9.5,10,3,0,0,90\n");
  EXPECT_EQ(hv.values.at(0).frequency_hz, 9.5e9);
  EXPECT_EQ(hv.values.at(0).theta_deg, 90);
  EXPECT_LT(
      std::abs(*read("a.csv", "f [GHz],az [deg],HV [dBsm],HV_phase [deg]\n9.5,10,0,90\n").values.at(0).amplitude_m -
               Complex(0, 1 / std::sqrt(4 * kPi))),
      1e-12);
  const std::string one = "azimuth_deg,frequency_ghz,rcs_dbsm\n10,9.5,-3\n";
  EXPECT_EQ(read("a.V.csv", one).element, Polarisation::kVv);
  EXPECT_EQ(read("a.csv", one, as(Polarisation::kHv, 9.5)).element, Polarisation::kHv);
  EXPECT_HAS(refusal("a.csv", one), "--reference-polarisation");
  EXPECT_EQ(read("a.csv", "azimuth_deg,hh_dbsm,vv_dbsm\n1,2,3\n", as(Polarisation::kVv)).values.at(0).level_dbsm, 3);
}

TEST_F(FieldTableFile, ByAzimuthIsRefusedWithoutAUnitOrWithWhatItContradicts) {
  const auto refused = [&](const char* text) { return refusal("a.csv", text, as(Polarisation::kHh)); };
  EXPECT_HAS(refused("azimuth,hh_dbsm\n1,2\n"), "azimuth has no unit");
  EXPECT_HAS(refused("azimuth_deg,HH\n1,2\n"), "column 'HH': its unit must be dBsm or m^2");
  EXPECT_HAS(refused("azimuth_deg,HH (dB)\n1,2\n"), "column 'HH (dB)': its unit must be dBsm or m^2");
  EXPECT_HAS(refused("azimuth_deg,elevation,hh_dbsm\n1,8,2\n"), "column 'elevation': its unit must be deg");
  EXPECT_HAS(refused("azimuth_deg,freq,hh_dbsm\n1,8,2\n"), "column 'freq': its unit must be Hz");
  EXPECT_HAS(refused("azimuth_deg,hh_dbsm,hh_phase\n1,8,2\n"), "column 'hh_phase': its unit must be deg");
  EXPECT_HAS(refusal("a.csv", "azimuth_deg,hh_dbsm\n1,2\n"), "give --reference-frequency-ghz");
  EXPECT_HAS(refusal("a.csv", "azimuth_deg,hh_dbsm\n1,2\n", as(Polarisation::kVv)), "no column of vv");
  FieldTableSettings settings = as(Polarisation::kHh);
  settings.elevation_deg = 8;
  EXPECT_HAS(refusal("a.csv", "azimuth_deg,elevation_deg,hh_dbsm\n1,7,2\n", settings),
             "a.csv: declares elevation 7 deg: remove --reference-elevation-deg 8");
}

}  // namespace
}  // namespace seaglint

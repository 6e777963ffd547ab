// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/names.h"
#include "sim/scenario/cases.h"
#include "sim/scenario/files/tables.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::StartsWith;

std::string code_refusal(const std::string& text) {
  return refusal_of([&] { read_hop_code({"hops.txt", text}, 4, 8); });
}

TEST(HopCodeText, IsReadWithAnySeparator) {
  const char* const marked =
      "\xef\xbb\xbf"
      "0\t7\t3 \t1\r\n";
  for (const char* text : {"0 7 3 1", "0,7,3,1\n", "0;7;3;1;\r\n", "# code\n0\n7\n\n3\n1\n", marked, "0\r7\r3\r1\r"})
    EXPECT_EQ(read_hop_code({"hops.txt", text}, 4, 8), (std::vector<int>{0, 7, 3, 1})) << text;
}

// numpy.savetxt, NumPy's print, MATLAB's save -ascii, writematrix, fprintf('%f') and disp, and Fortran.
TEST(HopCodeText, IsReadAsNumPyAndMatlabPrintIt) {
  for (const char* text :
       {"0.000000000000000000e+00\n7.000000000000000000e+00\n3.000000000000000000e+00\n1.000000000000000000e+00\n",
        "[0 7 3 1]\n", "[0. 7. 3. 1.]", "[[0, 7],\n [3, 1]]\n",
        "   0.0000000e+00   7.0000000e+00   3.0000000e+00   1.0000000e+00\n", "0,7,3,1\n",
        "0.000000\n7.000000\n3.000000\n1.000000\n",
        "  Columns 1 through 3\n\n     0     7     3\n\n  Column 4\n\n     1\n",
        "  Columns 1 and 2\n     0     7\n  Columns 3 and 4\n     3     1\n", " 0.0D+00 7.0D+00 3.0D+00 1.0D+00\n"})
    EXPECT_EQ(read_hop_code({"hops.txt", text}, 4, 8), (std::vector<int>{0, 7, 3, 1})) << text;
}

TEST(HopCodeText, OfNumPysSavetxtIsThatOfPlainNumbers) {
  const std::string folder = SEAGLINT_SOURCE_DIR "/tests/cases/tables/";
  const std::vector<int> plain = read_hop_code(TextSource::read(folder + "hop_plain.txt"), 256, 8);
  EXPECT_EQ(read_hop_code(TextSource::read(folder + "hop_numpy_savetxt.txt"), 256, 8), plain);
  for (const int carrier : {0, 1, 2, 3, 4, 5, 6, 7}) EXPECT_EQ(std::count(plain.begin(), plain.end(), carrier), 32);
}

TEST(HopCodeText, ThatCountsFromOneIsNamed) {
  EXPECT_EQ(code_refusal("1 8\n4 2\n"),
            "hops.txt:1:3: '8': must be a carrier's number, 0 to 7 (radar.hop_count - 1); the file counts from 1 to 8 "
            "and has no 0: subtract 1 from each number");
  for (const char* text : {"1 8 0 2", "1 9 4 2", "-1 8 4 2"})
    EXPECT_THAT(code_refusal(text), testing::Not(testing::HasSubstr("counts from 1"))) << text;
}

TEST(HopCodeText, IsRefusedWithThePlaceOfItsMistake) {
  EXPECT_EQ(code_refusal("0 7\n3 8\n"), "hops.txt:2:3: '8': must be a carrier's number, 0 to 7 (radar.hop_count - 1)");
  for (const char* word : {"-1", "1.5", "1x", "0x1", "+-1", "1e-1", "1e400", "nan", "1:2"})
    EXPECT_HAS(code_refusal(std::string("0 1 2 ") + word), "hops.txt:1:7: '" + std::string(word) + "'");
  EXPECT_EQ(code_refusal("0 1 2"), "hops.txt: 3 carrier numbers: must be radar.pulses, 4, or a multiple of them");
  EXPECT_HAS(code_refusal(std::string("\xff\xfe"
                                      "0\0 \0",
                                      6)),
             "UTF-16");
}

// Scatter diagrams as they are printed and exported are read, and drawn as often as they count.

std::string diagram_refusal(const std::string& text) {
  return refusal_of([&] { read_scatter_diagram({"s.csv", text}); });
}

// Cells as lines "height_low height_high period_low period_high count".
std::string cells_of(const std::string& text) {
  std::string lines;
  for (const ScatterCell& cell : read_scatter_diagram({"s.csv", text}).cells)
    lines += fmt::format("{:g} {:g} {:g} {:g} {:g}\n", cell.lowest_height_m, cell.highest_height_m,
                         cell.lowest_period_s, cell.highest_period_s, cell.count);
  return lines;
}

const char* const kCells =
    "0 1 4 6 10\n"
    "0 1 6 8 30\n"
    "1 2 6 8 20\n"
    "2 3 8 10 5\n";

TEST(ScatterDiagram, IsReadInAnyLayoutAndWithAnySeparator) {
  for (const char* text :
       {"Hs/Tp,5,7,9\n0.5,10,30,0\n1.5,0,20,0\n2.5,0,0,5\n",
        "# North Sea, counts\nHs [m] \\ Tp [s];5;7;9;Sum\n0,5;10;30;0;40\n1,5;;20;;20\n2,5;0;0;5;5\nSum;10;50;5;65\n",
        "significant_wave_height_m/peak_period_s\t4-6\t6-8\t8-10\n0-1\t10\t30\t-\n1 - 2\t0\t20\t0\n2 to 3\t0\t0\t5\n",
        "Tp/Hs 0.5 1.5 2.5\n5 10 0 0\n7 30 20 0\n9 0 0 5\n",
        "hs_m,tp_s,count\n0.5,5,10\n0.5,7,30\n1.5,7,20\n2.5,9,5\n2.5,5,0\n",
        "count;peak_period_s;significant_wave_height_m\n5;9;2,5\n20;7;1,5\n30;7;0,5\n10;5;0,5\n"}) {
    EXPECT_EQ(cells_of(text), kCells) << text;
    EXPECT_EQ(read_scatter_diagram({"s.csv", text}).period_key, "peak_period_s");
  }
}

TEST(ScatterDiagram, IsRefusedWithThePlaceOfItsMistake) {
  const std::pair<const char*, const char*> cases[] = {
      {"5,7\n0.5,10,30\n", "s.csv: no scatter diagram: its first cell must name"},
      {"Hs/Tx,5,7\n0.5,10,30\n1.5,1,1\n", "s.csv: no scatter diagram"},
      {"", "s.csv: no scatter diagram"},
      {"Hs/Tp,5,seven\n0.5,10,30\n", "s.csv:1:9: 'seven': must be a period"},
      {"Hs/Tp,5,5\n0.5,10,30\n", "s.csv:1:9: '5': appears twice"},
      {"Hs/Tp,5,7\n0.5,10,-30\n1.5,0,0\n", "s.csv:2:8: '-30': must be a count"},
      {"Hs/Tp,5,7\n0.5,10,nan\n1.5,0,0\n", "s.csv:2:8: 'nan': must be a count"},
      {"Hs/Tp,5,7\n0.5,10\n1.5,0,0\n", "s.csv:2:1: 2 cells where the first row has 3"},
      {"Hs/Tp,5,7\n0.5,10,1,2\n1.5,0,0\n", "4 cells where the first row has 3"},
      {"Hs/Tp,5,7\n0.5,0,0\n1.5,0,0\n", "s.csv: all counts are 0"},
      {"Hs/Tp,5,7\n0.5,1,0\n", "s.csv:2:1: '0.5': wave heights must be centres of two or more equal cells"},
      {"Hs/Tp,5,7,10\n0.5,1,0,1\n1.5,1,0,1\n", "s.csv:1:11: '10': periods must be centres of two or more equal cells"},
      {"Hs/Tp,5,7-9\n0.5,1,0\n1.5,1,0\n", "all be centres of cells, or all cells LOW-HIGH"},
      {"Hs/Tp,5,7\n0,1,0\n1,1,0\n", "s.csv:2:1: '0': its cell, -0.5 to 0.5, begins below 0"},
      {"hs_m,tp_s,count\n0.5,5,10\n0.5,5,30\n1.5,7,20\n", "this pair of height and period appears twice"},
      {"hs_m,tp_s,count\n0.5,5,10\n1.5,7,-1\n", "must be"}};
  for (const auto& [text, message] : cases) EXPECT_HAS(diagram_refusal(text), message) << text;
}

// Pearson's statistic of 4 cells has 3 degrees of freedom: 21.1 is exceeded with probability 1e-4; the means of u over
// a cell of n draws have the standard deviation 1/sqrt(12 n).
TEST(ScatterDiagram, IsDrawnAsOftenAsItCountsAndUniformlyWithinItsCells) {
  const ScatterDiagram diagram = read_scatter_diagram({"s.csv", "Hs/Tp,5,7,9\n0.5,10,30,0\n1.5,0,20,0\n2.5,0,0,5\n"});
  constexpr int kDraws = 20000;
  std::vector<double> counts(diagram.cells.size()), heights(counts.size()), periods(counts.size());
  for (int i = 0; i < kDraws; ++i) {
    Random random({1, Stream::kTest, static_cast<std::uint64_t>(i)});
    const SeaPair pair = diagram.draw(random);
    std::size_t inside = 0;
    for (std::size_t c = 0; c < counts.size(); ++c) {
      const ScatterCell& cell = diagram.cells[c];
      const double u =
          (pair.significant_wave_height_m - cell.lowest_height_m) / (cell.highest_height_m - cell.lowest_height_m);
      const double v = (pair.period_s - cell.lowest_period_s) / (cell.highest_period_s - cell.lowest_period_s);
      if (u < 0 || u > 1 || v < 0 || v > 1) continue;
      ++inside;
      ++counts[c];
      heights[c] += u;
      periods[c] += v;
    }
    ASSERT_EQ(inside, 1u) << pair.significant_wave_height_m << " " << pair.period_s;
  }
  double chi_squared = 0;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const double expected = kDraws * diagram.cells[c].count / diagram.count();
    chi_squared += (counts[c] - expected) * (counts[c] - expected) / expected;
    for (const double sum : {heights[c], periods[c]})
      EXPECT_NEAR(sum / counts[c], 0.5, 5 / std::sqrt(12 * counts[c])) << c;
  }
  EXPECT_LT(chi_squared, 21.1);
}

TEST(ScatterDiagram, WithoutSomeCellsStatesTheirPartOfTheCounts) {
  ScatterDiagram diagram = read_scatter_diagram({"s.csv", "Hs/Tp,5,7,9\n0.5,10,30,0\n1.5,0,20,0\n2.5,0,0,5\n"});
  EXPECT_EQ(diagram.likeliest().period_s, 7);
  EXPECT_EQ(diagram.likeliest().significant_wave_height_m, 0.5);
  exclude_cells(diagram, {false, true, false, true});
  EXPECT_EQ(diagram.cells.size(), 2u);
  EXPECT_EQ(diagram.excluded_cells, 2u);
  EXPECT_NEAR(diagram.excluded_fraction, 35.0 / 65, 1e-15);
}

// Wave spectra from files, and the sea section's keys that belong together.

namespace fs = std::filesystem;

std::string complaint(const std::string& table) {
  return refusal_of([&] { read_spectrum_table({"s.csv", table}); });
}

TEST(SpectrumTable, IsReadInEitherUnit) {
  const SpectrumTable a = read_spectrum_table({"s.csv", "# a buoy\nomega_rad_s,density_m2_s\n0.5,0\n1,2\n2,1\n"});
  EXPECT_DOUBLE_EQ(a.energy(), 0.5 + 1.5);
  EXPECT_EQ(a.peak_omega(), 1);
  const SpectrumTable b =
      read_spectrum_table({"s.csv", "station, density_m2_hz ,frequency_hz\r\nx,1,0\r\nx,3,0.25\r\n"});
  EXPECT_DOUBLE_EQ(b.energy(), 0.25 * 2);  // energy does not depend on the unit
  EXPECT_DOUBLE_EQ(b.omega[1], kPi / 2);
}

TEST(SpectrumTable, IsReadAsOtherProgramsWriteIt) {
  const SpectrumTable marked =
      read_spectrum_table(TextSource::read(SEAGLINT_SOURCE_DIR "/tests/cases/tables/spectrum_bom.csv"));
  ASSERT_EQ(marked.omega.size(), 5u);
  EXPECT_EQ(marked.peak_omega(), 0.8);
  const SpectrumTable other =
      read_spectrum_table({"s.csv", "Buoy 3\nFrequency [Hz];Density [m^2/Hz]\n0,05;0\n0,10;1,5\n0,20;0\n"});
  EXPECT_DOUBLE_EQ(other.energy(), 0.5 * 1.5 * 0.15);
  EXPECT_DOUBLE_EQ(other.peak_omega(), 2 * kPi * 0.1);
}

// One triangle of 1.5 m^2/Hz from 0.05 to 0.2 Hz.
void expect_triangle(const std::string& text, const std::string& time = "") {
  const SpectrumTable table = read_spectrum_table({"s.csv", text}, time);
  EXPECT_NEAR(table.energy(), 0.5 * 1.5 * 0.15, 1e-12) << text;
  EXPECT_NEAR(table.peak_omega(), 2 * kPi * 0.1, 1e-12) << text;
}

TEST(SpectrumTable, IsReadByTheNamesOfOtherPrograms) {
  expect_triangle(",\"JONSWAP (2.5m,8.0s)\"\n0.05,0\n0.1,1.5\n0.2,0\n");
  expect_triangle("Frequency,Bretschneider (2.5m)\n0.05,0\n0.1,1.5\n0.2,0\n");
  expect_triangle("f,S\n0.05,0\n0.1,1.5\n0.2,0\n");
  expect_triangle("Frequency (Hz),Energy Density (m^2/Hz)\n0.05,0\n0.1,1.5\n0.2,0\n");
  expect_triangle("freq [Hz];spectral density [m\xc2\xb2/Hz]\n0.05;0\n0.1;1.5\n0.2;0\n");
  const std::string omega =
      fmt::format("omega,S\n{},0\n{},{}\n{},0\n", 2 * kPi * 0.05, 2 * kPi * 0.1, 1.5 / (2 * kPi), 2 * kPi * 0.2);
  expect_triangle(omega);
  EXPECT_EQ(read_spectrum_table({"s.csv", "f,S\n0.05,0\n0.1,1.5\n"}).reading, "f in Hz, s in m^2/Hz");
}

constexpr const char* kHistorical =
    "#YY  MM DD hh mm  .0500  .1000  .2000\n"
    "2018 01 01 00 40   0.00   1.00   0.00\n"
    "2018 01 01 01 40   0.00   1.50   0.00\n"
    "2018 01 01 02 40 999.00   1.50   0.00\n";

TEST(SpectrumTable, IsReadFromFilesOfNdbc) {
  expect_triangle(kHistorical, "2018-01-01 01:40");
  expect_triangle(kHistorical, "2018-01-01T01:40:00");
  EXPECT_EQ(read_spectrum_table({"s.txt", kHistorical}, "201801010140").reading,
            "NDBC, Hz and m^2/Hz, of 2018-01-01 01:40");
  expect_triangle("YY MM DD hh .05 .10 .20\n96 12 31 23 0.0 1.5 0.0\n");
  expect_triangle(
      "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) ... >\n"
      "2026 07 30 01 50 0.120 0.000 (0.050) 1.500 (0.100) 0.000 (0.200)\n");
  const auto complaint = [](const std::string& time) {
    return refusal_of([&] { read_spectrum_table({"s.txt", kHistorical}, time); });
  };
  EXPECT_EQ(complaint(""), "s.txt: 3 spectra, 2018-01-01 00:40 to 2018-01-01 02:40: sea.table_time must choose one");
  EXPECT_EQ(complaint("2018-01-01 01:41"),
            "s.txt: 3 spectra, 2018-01-01 00:40 to 2018-01-01 02:40: none of sea.table_time '2018-01-01 01:41'");
  EXPECT_EQ(complaint("2018-01-01 02:40"), "s.txt:4:18: spectral density: missing in this spectrum");
}

std::string swan(const std::string& directions, const std::string& unit, const std::string& rows) {
  return "SWAN   1                                Swan standard spectral file, version\n"
         "$   Data produced by SWAN version 41.31\n"
         "TIME                                    time-dependent data\n     1        time coding option\n"
         "LOCATIONS                               locations in x-y-space\n     1     number of locations\n 10.0 20.0\n"
         "AFREQ                                   absolute frequencies in Hz\n     3\n 0.05\n 0.1\n 0.2\n" +
         directions + "QUANT\n" + unit + rows;
}

TEST(SpectrumTable, IsReadFromFilesOfSwan) {
  const std::string three =
      "     3      number of quantities in table\nVaDens      variance densities in m2/Hz\nm2/Hz        unit\n"
      "   -0.9900E+02      exception value\nNDIR\ndegr\n   -0.9990E+03\nDSPRDEGR\ndegr\n   -0.9000E+01\n";
  const std::string rows =
      "19680606.030000                         date and time\nLOCATION     1\n 0.0 190.1 24.9\n 0.15E+01 190 25\n 0 "
      "190 "
      "25\n";
  expect_triangle(swan("", three, rows));
  expect_triangle(swan("", three, rows), "1968-06-06 03:00");
  // Joules per square metre are rho g times the variance.
  const std::string energy = "     1\nEnDens\nJ/m2/Hz\n -99\n";
  expect_triangle(swan("", energy, fmt::format("19680606.0300\nLOCATION 1\n0\n{}\n0\n", 1.5 * 1025 * 9.81)));
  // Four directions of 90 deg, with a factor.
  const std::string directions = "NDIR\n     4\n 0\n 90\n 180\n 270\n", density = "     1\nVaDens\nm2/Hz/degr\n -99\n";
  expect_triangle(
      swan(directions, density, fmt::format("19680606.0300\nFACTOR\n{}\n 0 0 0 0\n 1 2 3 4\n 0 0 0 0\n", 1.5 / 900)));
  const auto complaint = [](const std::string& text, const char* time = "") {
    return refusal_of([&] { read_spectrum_table({"s.spc", text}, time); });
  };
  EXPECT_EQ(complaint(swan("", three, rows + "19680606.040000\nLOCATION     1\nNODATA\n")),
            "s.spc: 2 spectra, 1968-06-06 03:00 to 1968-06-06 04:00: sea.table_time must choose one");
  EXPECT_EQ(complaint(swan("", three, rows + "19680606.040000\nLOCATION     1\nNODATA\n"), "1968-06-06 04"),
            "s.spc: no data in this spectrum");
  EXPECT_EQ(complaint(swan("", "     1\nHsig\nm\n -99\n", rows)), "s.spc: no quantity VaDens or EnDens");
  EXPECT_EQ(complaint(swan("", three, "19680606.03\nLOCATION 1\n 0 1 2\n -99 1 2\n 0 1 2\n")),
            "s.spc:27:2: variance density: the exception value, no data");
}

TEST(SpectrumTable, IsRefusedForEveryMistake) {
  const std::string header = "omega_rad_s,density_m2_s\n";
  EXPECT_EQ(complaint(""), "s.csv: 0 rows: the file is empty: must be a table with a header");
  EXPECT_EQ(complaint("omega_rad_s,density\n1,2\n"),
            "s.csv:1:13: density has no unit: must be named density_m2_s or density_m2_s_rad or density_m2_hz, or have "
            "a row of units below");
  EXPECT_EQ(complaint("omega_rad_s,energy\n1,2\n"),
            "s.csv:1:1: no column density_m2_s; the columns are omega_rad_s, energy (it may be called "
            "density_m2_s_rad, density_m2_hz, s_m2_hz, s_m2_s_rad, s_m2_rad_s and more)");
  EXPECT_EQ(complaint(header + "1,2\n"), "s.csv: 1 rows of numbers below the names: must be at least 2");
  EXPECT_EQ(complaint(header + "1,2\n1,3\n"), "s.csv:3:1: omega_rad_s: value '1': must be greater than 1 of line 2");
  EXPECT_EQ(complaint(header + "1,2\n\n0.5,3\n"),
            "s.csv:4:1: omega_rad_s: value '0.5': must be greater than 1 of line 2");
  EXPECT_EQ(complaint(header + "-1,2\n2,3\n"), "s.csv:2:1: omega_rad_s: value '-1': must be at least 0");
  EXPECT_EQ(complaint(header + "1,nan\n2,3\n"), "s.csv:2:3: density_m2_s: value 'nan': must be a finite number");
  EXPECT_EQ(complaint(header + "1,2\n2,-3\n"), "s.csv:3:3: density_m2_s: value '-3': must be at least 0");
  EXPECT_EQ(complaint(header + "1,2\n2\n"), "s.csv:3:1: 1 cells where the names are 2, separated by ','");
  EXPECT_EQ(complaint(header + "1,0\n2,0\n"), "s.csv: all densities are 0");
}

class SeaKeys : public testing::Test {
 protected:
  SeaKeys() { write_file(folder_ / "buoy.csv", "omega_rad_s,density_m2_s\n0.4,0\n0.8,0.5\n1.6,0\n"); }
  Scenario read(const std::string& sea) const {
    return parse_scenario("seaglint: 1\ntargets: {a: {label: 1, mesh: a.glb}}\nsea: {" + sea + "}\n",
                          folder_ / "file.yaml");
  }
  std::string complaint(const std::string& sea) const {
    try {
      read(sea);
    } catch (const InputError& error) {
      const std::string text = error.what();
      return text.substr(text.find(": sea") == std::string::npos ? 0 : text.find(": sea") + 2);
    }
    return "accepted";
  }
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(SeaKeys, ATableHasPeakAndHeight) {
  const Scenario own = read("spectrum: table, table: buoy.csv, significant_wave_height_m: from_table");
  const SeaState state = sea_states(own.sea).at(0);
  EXPECT_DOUBLE_EQ(state.significant_wave_height_m, 4 * std::sqrt(0.3));
  EXPECT_DOUBLE_EQ(state.peak_period_s, 2 * kPi / 0.8);
  EXPECT_EQ(state.cutoff_rad_s, 1.6);
  const Scenario scaled = read("spectrum: table, table: buoy.csv, significant_wave_height_m: [1, 2]");
  EXPECT_EQ(sea_states(scaled.sea).at(1).significant_wave_height_m, 2);
  // The effective scenario contains the same.
  const Scenario again = parse_scenario(effective_yaml(own), folder_ / "again.yaml");
  EXPECT_EQ(effective_yaml(again), effective_yaml(own));
  EXPECT_EQ(sea_states(again.sea).at(0).peak_period_s, state.peak_period_s);
}

TEST_F(SeaKeys, RulesSetPeriodAndGamma) {
  // DNV-RP-C205, 3.5.5.5, at its three branches.
  EXPECT_EQ(sea_states(read("significant_wave_height_m: 4, peak_period_s: 7, gamma: dnv_rule").sea)[0].gamma, 5);
  EXPECT_EQ(sea_states(read("significant_wave_height_m: 4, peak_period_s: 10, gamma: dnv_rule").sea)[0].gamma, 1);
  EXPECT_NEAR(sea_states(read("significant_wave_height_m: 4, peak_period_s: 8, gamma: dnv_rule").sea)[0].gamma,
              std::exp(5.75 - 1.15 * 4), 1e-12);
  // 10 m/s over 100 km: g F/U^2 = 9810, f = 3.5 g/U 9810^-0.33.
  const Scenario fetch =
      read("significant_wave_height_m: 1, peak_period_s: wind_and_fetch, wind: {speed_mps: 10, fetch_km: 100}");
  EXPECT_NEAR(sea_states(fetch.sea)[0].peak_period_s, 10 / 9.81 / 3.5 * std::pow(9810, 0.33), 1e-12);
  EXPECT_NEAR(sea_states(fetch.sea)[0].peak_period_s, 6.0, 0.1);
  EXPECT_EQ(sea_states(read("spectrum: bretschneider").sea)[0].gamma, 1);
}

// Ratios of Te and Tz to Tp: closed forms at gamma 1, the fit of DNV-RP-C205 (2010), 3.5.5.4, otherwise, and moments of
// the spectrum that the sea is made of.
TEST_F(SeaKeys, MeanPeriodsGiveThePeakPeriod) {
  EXPECT_NEAR(energy_period_ratio(1), 1.25 * std::tgamma(1.25) * std::pow(1.25, -1.25), 1e-12);
  EXPECT_NEAR(zero_crossing_period_ratio(1), std::sqrt(0.8 / std::sqrt(kPi / 1.25)), 1e-12);
  for (const double gamma : {1.0, 2.0, 3.3, 5.0, 7.0}) {
    const double fit = 0.6673 + 0.05037 * gamma - 0.006230 * gamma * gamma + 0.0003341 * gamma * gamma * gamma;
    EXPECT_NEAR(zero_crossing_period_ratio(gamma), fit, 2e-3) << gamma;
    double before = 0, mean = 0, squares = 0;
    for (int n = 1; n < 400000; ++n) {
      const double u = 1e-4 * n, r = std::exp(-0.5 * std::pow((u - 1) / (u <= 1 ? 0.07 : 0.09), 2));
      const double density = std::pow(u, -5) * std::exp(-1.25 * std::pow(u, -4)) * std::pow(gamma, r);
      before += density / u, mean += density, squares += density * u * u;
    }
    EXPECT_NEAR(energy_period_ratio(gamma), before / mean, 1e-5) << gamma;
    EXPECT_NEAR(zero_crossing_period_ratio(gamma), std::sqrt(mean / squares), 4e-4) << gamma;  // the tail above u = 40
  }
  const SeaState energy = sea_states(read("energy_period_s: 8, gamma: 3.3").sea)[0];
  EXPECT_NEAR(energy.peak_period_s, 8 / energy_period_ratio(3.3), 1e-12);
  EXPECT_EQ(energy.gamma, 3.3);
  const SeaState crossing = sea_states(read("spectrum: bretschneider, zero_crossing_period_s: 6").sea)[0];
  EXPECT_NEAR(crossing.peak_period_s, 6 / 0.71042, 1e-3);
  // A sweep of periods and gammas has all pairs, periods slowest.
  const auto states = sea_states(read("energy_period_s: [7, 9], gamma: [1, 5]").sea);
  ASSERT_EQ(states.size(), 4u);
  EXPECT_NEAR(states[1].peak_period_s, 7 / energy_period_ratio(5), 1e-12);
  EXPECT_NEAR(states[2].peak_period_s, 9 / energy_period_ratio(1), 1e-12);
  // The rule for gamma holds for the peak period that follows.
  const SeaState rule = sea_states(read("significant_wave_height_m: 4, energy_period_s: 7.4, gamma: dnv_rule").sea)[0];
  EXPECT_NEAR(rule.peak_period_s, 7.4 / energy_period_ratio(rule.gamma), 1e-9);
  EXPECT_NEAR(rule.gamma, std::exp(5.75 - 1.15 * rule.peak_period_s / 2), 1e-9);
  const SeaState swell = sea_states(
      read("swell: {significant_wave_height_m: 1, zero_crossing_period_s: 9, gamma: 5, coming_from_deg: 10}").sea)[0];
  EXPECT_NEAR(swell.swell.peak_period_s, 9 / zero_crossing_period_ratio(5), 1e-12);
  EXPECT_NEAR(swell.swell.propagation_rad, radians(190), 1e-12);
}

// Waves that come from ahead (0) are a head sea, propagation 180 (CONVENTIONS.md, "Frames").
TEST_F(SeaKeys, WavesComeFromTheOppositeOfTheirPropagation) {
  const auto states = sea_states(read("coming_from_deg: [0, 90, 180, 270, -30, 350]").sea);
  ASSERT_EQ(states.size(), 6u);
  const double towards[] = {180, 270, 0, 90, 150, 170};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(states[i].propagation_deg, towards[i]) << i;
}

TEST_F(SeaKeys, ThatStateOneQuantityExcludeEachOther) {
  EXPECT_EQ(complaint("peak_period_s: 8, energy_period_s: 7"),
            "sea.energy_period_s: value '7': not allowed here: valid only without sea.peak_period_s");
  EXPECT_EQ(complaint("propagation_deg: 8, coming_from_deg: 7"),
            "sea.coming_from_deg: value '7': not allowed here: valid only without sea.propagation_deg");
  EXPECT_EQ(
      complaint("swell: {zero_crossing_period_s: 8, peak_period_s: 7}"),
      "sea.swell.zero_crossing_period_s: value '8': not allowed here: valid only without sea.swell.peak_period_s");
  EXPECT_EQ(complaint("coming_from_deg: [10, -350]"),
            "sea.coming_from_deg: -350 and 10 are the same direction: list it once");
  EXPECT_EQ(complaint("zero_crossing_period_s: 39"),
            "sea.zero_crossing_period_s: value '39': its peak period is 50.17 s: must be within 0.5 and 40");
  EXPECT_EQ(complaint("spectrum: table, table: buoy.csv, energy_period_s: 8"),
            "sea.energy_period_s: value '8': not allowed here: valid only with spectrum: jonswap or bretschneider; a "
            "table has its own peak");
  EXPECT_EQ(complaint("spectrum: table, table: buoy.csv, table_time: 2018"), "sea.table_time is not allowed here");
  // --set of one replaces another.
  const Scenario set = parse_scenario(
      "seaglint: 1\ntargets: {a: {label: 1, mesh: a.glb}}\nsea: {peak_period_s: 8, propagation_deg: 10}\n", "file.yaml",
      {{"sea.energy_period_s", "7"}, {"sea.coming_from_deg", "20"}});
  EXPECT_EQ(sea_states(set.sea)[0].propagation_deg, 200);
  EXPECT_NEAR(sea_states(set.sea)[0].peak_period_s, 7 / energy_period_ratio(3.3), 1e-12);
  EXPECT_EQ(effective_yaml(set).find("\n  peak_period_s"), std::string::npos);
  // They are drawn as the others are.
  const Scenario drawn = read("energy_period_s: uniform(6 8), coming_from_deg: uniform(0 360)");
  EXPECT_EQ(drawn.variations.size(), 2u);
  const SeaState state = sea_states(drawn_scenario(drawn, {3, 0, 0}).sea)[0];
  EXPECT_NE(state.propagation_deg, sea_states(drawn.sea)[0].propagation_deg);
  EXPECT_GE(state.peak_period_s, 6 / energy_period_ratio(3.3));
  EXPECT_LE(state.peak_period_s, 8 / energy_period_ratio(3.3));
}

TEST_F(SeaKeys, DepthAndSwellReachTheState) {
  const SeaState state =
      sea_states(read("depth_m: 12, swell: {significant_wave_height_m: 0.5, propagation_deg: 40}").sea)[0];
  EXPECT_EQ(state.depth_m, 12);
  EXPECT_EQ(state.swell.significant_wave_height_m, 0.5);
  EXPECT_NEAR(total_wave_height(state), std::sqrt(1.25), 1e-15);
  EXPECT_NEAR(convergent_cutoff(state), std::sqrt(2 * kGravity / std::sqrt(1.25)), 1e-12);
  EXPECT_EQ(sea_states(read("order: 1").sea)[0].depth_m, kDeepWater);
}

// A height whose square overflows would give a sea of NaN.
TEST_F(SeaKeys, WavesAreZeroOrHighEnoughToSquare) {
  for (const char* height : {"1e-162", "9e-7", "30.1"}) {
    EXPECT_EQ(complaint(fmt::format("significant_wave_height_m: {}", height)),
              fmt::format("sea.significant_wave_height_m: value '{}': must be a number, a list or from:to:step, "
                          "0 or within 1e-06 and 30, or from_table",
                          height));
    EXPECT_EQ(complaint(fmt::format("swell: {{significant_wave_height_m: {}}}", height)),
              fmt::format("sea.swell.significant_wave_height_m: value '{}': must be 0 or a number within 1e-06 and 30",
                          height));
  }
  for (const char* height : {"0", "1e-6"}) {
    EXPECT_EQ(
        complaint(fmt::format("significant_wave_height_m: {0}, swell: {{significant_wave_height_m: {0}}}", height)),
        "accepted");
  }
}

TEST_F(SeaKeys, ThatContradictEachOtherAreNamed) {
  EXPECT_EQ(complaint("depth_m: 0"), "sea.depth_m: value '0': must be a number within 0.5 and 12000");
  EXPECT_EQ(complaint("spectrum: table"), "sea.table: this key is missing");
  EXPECT_EQ(complaint("spectrum: table, table: none.csv"),
            "sea.table: value 'none.csv': no such file, " + places_text(folder_));
  EXPECT_EQ(complaint("table: buoy.csv"),
            "sea.table: value 'buoy.csv': not allowed here: valid only with spectrum: table");
  EXPECT_EQ(
      complaint("spectrum: table, table: buoy.csv, peak_period_s: 8"),
      "sea.peak_period_s: value '8': not allowed here: valid only with spectrum: jonswap or bretschneider; a table "
      "has its own peak");
  EXPECT_EQ(complaint("spectrum: bretschneider, gamma: 2"),
            "sea.gamma: value '2': not allowed here: valid only with spectrum: jonswap");
  EXPECT_EQ(complaint("significant_wave_height_m: from_table"),
            "sea.significant_wave_height_m: value 'from_table': must be a number without spectrum: table");
  EXPECT_EQ(complaint("wind: {speed_mps: 10}"),
            "sea.wind: not allowed here: valid only with peak_period_s: wind_and_fetch");
  EXPECT_EQ(
      complaint("cutoff_rad_s: 0.7"),
      "sea.cutoff_rad_s: value '0.7': must be above the peak, 0.7854 rad/s (four times the peak contains all but 0.4 % "
      "of the energy)");
  EXPECT_EQ(
      complaint("significant_wave_height_m: 2, depth_m: 2"),
      "sea.significant_wave_height_m: value '2': waves of 2 m break at a peak period of 8 s in 2 m of water: must be "
      "at most 1.721 m");
  EXPECT_EQ(
      complaint("swell: {significant_wave_height_m: 3, peak_period_s: 3}"),
      "sea.swell.significant_wave_height_m: value '3': waves of 3 m break at a peak period of 3 s: must be at most "
      "2.007 m");
  EXPECT_EQ(
      complaint("swell: {significant_wave_height_m: 0.02, peak_period_s: 0.5}"),
      "sea.swell.peak_period_s: value '0.5': must be greater than 0.7854, the period of the sea's cut-off, 8 rad/s");
  EXPECT_EQ(
      complaint("significant_wave_height_m: 0.5, peak_period_s: [2, 12], swell: {significant_wave_height_m: 0.02, "
                "peak_period_s: 0.7}"),
      "sea.swell.peak_period_s: value '0.7': must be greater than 0.7854, the period of the sea's cut-off, 8 rad/s");
  EXPECT_EQ(complaint("significant_wave_height_m: 0.5, peak_period_s: 2, swell: {significant_wave_height_m: 0.02, "
                      "peak_period_s: 0.7}"),
            "accepted");
  EXPECT_EQ(complaint("swell: {peak_period_s: 0.5}"), "accepted");
  EXPECT_EQ(complaint("components: 3000, depth_m: 20"),
            "sea.components: value '3000': with those of the swell must be at most 2048 at order 2 in a sea of finite "
            "depth or of several directions, whose cost grows with their square");
}

}  // namespace
}  // namespace seaglint

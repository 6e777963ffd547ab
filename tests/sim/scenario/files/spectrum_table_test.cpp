// SPDX-License-Identifier: BSD-3-Clause
// Wave spectra from files, and the sea section's keys that belong together.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/data_folder.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/writer.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

std::string complaint(const std::string& table) {
  try {
    parse_spectrum_table(table, "s.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SpectrumTable, IsReadInEitherUnit) {
  const SpectrumTable a = parse_spectrum_table("# a buoy\nomega_rad_s,density_m2_s\n0.5,0\n1,2\n2,1\n", "s.csv");
  EXPECT_DOUBLE_EQ(a.energy(), 0.5 + 1.5);
  EXPECT_EQ(a.peak_omega(), 1);
  const SpectrumTable b =
      parse_spectrum_table("station, density_m2_hz ,frequency_hz\r\nx,1,0\r\nx,3,0.25\r\n", "s.csv");
  EXPECT_DOUBLE_EQ(b.energy(), 0.25 * 2);  // energy does not depend on the unit
  EXPECT_DOUBLE_EQ(b.omega[1], kPi / 2);
}

TEST(SpectrumTable, IsReadAsOtherProgramsWriteIt) {
  const SpectrumTable marked = read_spectrum_table(SEAGLINT_SOURCE_DIR "/tests/cases/tables/spectrum_bom.csv");
  ASSERT_EQ(marked.omega.size(), 5u);
  EXPECT_EQ(marked.peak_omega(), 0.8);
  const SpectrumTable other =
      parse_spectrum_table("Buoy 3\nFrequency [Hz];Density [m^2/Hz]\n0,05;0\n0,10;1,5\n0,20;0\n", "s.csv");
  EXPECT_DOUBLE_EQ(other.energy(), 0.5 * 1.5 * 0.15);
  EXPECT_DOUBLE_EQ(other.peak_omega(), 2 * kPi * 0.1);
}

TEST(SpectrumTable, IsRefusedForEveryMistake) {
  const std::string header = "omega_rad_s,density_m2_s\n";
  EXPECT_EQ(complaint(""), "s.csv: 0 rows: the file is empty: must be a table with a header");
  EXPECT_EQ(complaint("omega_rad_s,density\n1,2\n"),
            "s.csv:1:13: density has no unit: must be named density_m2_s or density_m2_s_rad or density_m2_hz, or have "
            "a row of units below");
  EXPECT_EQ(complaint("omega_rad_s,energy\n1,2\n"),
            "s.csv:1:1: no column density_m2_s; the columns are omega_rad_s, energy (it may be called "
            "density_m2_s_rad, density_m2_hz)");
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
  SeaKeys() : folder_(fs::path(testing::TempDir()) / fmt::format("sea_keys_{}", ::getpid())) {
    fs::create_directories(folder_);
    write_file(folder_ / "buoy.csv", "omega_rad_s,density_m2_s\n0.4,0\n0.8,0.5\n1.6,0\n");
  }
  ~SeaKeys() override { fs::remove_all(folder_); }
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
  fs::path folder_;
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

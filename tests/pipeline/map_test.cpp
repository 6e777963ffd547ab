// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

using ::testing::HasSubstr;

// `seaglint map` on ideal points.

// One approaching point 30 m nearer than the reference point, viewed from ahead.
const Words kOnePoint = {
    "--set", "view={azimuth_deg: 0, elevation_deg: 0}", "--set",
    "targets={line: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.5, 0, 0]}]}}"};

std::vector<std::string> map_of(const std::string& output, Words more = {}) {
  return with({"map", kPoints, "-o", output}, more);
}

TEST(MapCommand, DrawsTheMapAndListsTheCentre) {
  const TemporaryFolder folder;
  const ProgramResult result = completed(map_of(folder.path() / "map.png", kOnePoint));
  EXPECT_TRUE(read_file(folder.path() / "map.png").starts_with("\x89PNG"));
  std::istringstream lines(result.out);
  std::string header;
  double range_m = 0, velocity_mps = 0, amplitude_m = 0;
  std::getline(lines, header);
  lines >> range_m >> velocity_mps >> amplitude_m;
  EXPECT_NEAR(range_m, -30, 0.075);         // a tenth of a cell
  EXPECT_NEAR(velocity_mps, -1.5, 0.0146);  // approaching
  EXPECT_NEAR(amplitude_m, 2, 0.04);        // 20 dB of clutter per pulse, 50 dB in the peak cell
  EXPECT_THAT(result.out, HasSubstr("SCR per pulse 20.00 dB"));
}

// A chirp narrower than the carrier step leaves gaps in the band, and centres are listed at empty places.
TEST(MapCommand, EchoAndGenerateWarnOfGapsInTheBand) {
  const TemporaryFolder folder;
  const std::string warning =
      "seaglint: warning: radar.bandwidth_mhz: 24 MHz between the bands of neighbouring carriers: range sidelobes "
      "every 5.996 m\n";
  const std::vector<std::string> gaps{"--set", "radar.bandwidth_mhz=1"};
  const Words echo = with({"echo", kPoints, "-o", folder.path() / "echo.npz"}, gaps),
              generate = with(with({"generate", kPoints, "-o", folder.path() / "data"}, gaps),
                              {"--set", "dataset={maps_per_case: 1, realisations_per_case: 1}"});
  for (const Words& words : {map_of(folder.path() / "map.png", gaps), echo, generate}) {
    EXPECT_THAT(completed(words).err, HasSubstr(warning)) << words[0];
  }
  EXPECT_EQ(run_program(map_of(folder.path() / "map.png")).err, "");
}

TEST(MapCommand, APointOnAConductingSeaIsFourTimesAsStrong) {
  // On the plane itself all four paths are equal, and rho_v = +1.
  const TemporaryFolder folder;
  const auto amplitude = [&](Words more) {
    const std::vector<std::string> scene = {
        "--set", "view={azimuth_deg: 0, elevation_deg: 2}", "--set",
        "targets={line: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2}]}}"};
    const ProgramResult result = completed(map_of(folder.path() / "map.png", with(scene, more)));
    std::istringstream lines(result.out);
    std::string header;
    double range_m = 0, velocity_mps = 0, amplitude_m = 0;
    std::getline(lines, header);
    lines >> range_m >> velocity_mps >> amplitude_m;
    return amplitude_m;
  };
  EXPECT_NEAR(amplitude({}), 2, 0.04);
  EXPECT_NEAR(amplitude({"--set", "sea_reflection={enabled: true, surface: conductor, roughness: none}"}), 8, 0.16);
  EXPECT_NEAR(amplitude({"--set",
                         "sea_reflection={enabled: true, surface: conductor, roughness: none, paths: multipath_only}"}),
              6, 0.12);
}

TEST(MapCommand, RefusesASeaReflectionWithoutAnImage) {
  const TemporaryFolder folder;
  const Words more = with(kOnePoint, {"--set", "sea_reflection.enabled=true"});  // at elevation 0
  expect_refused(map_of(folder.path() / "map.png", more),
                 "view.elevation_deg: value '0': must be greater than 0 with sea_reflection");
}

TEST(MapCommand, RefusesARadarThatDescendsBelowTheReflectingSea) {
  // 64 ms at 1000 m/s, from 0.2 deg at 10 km.
  const TemporaryFolder folder;
  const Words more =
      with(kOnePoint, {"--set", "view.elevation_deg=0.2", "--set", "sea_reflection.enabled=true", "--set",
                       "radar.range_km=10", "--set", "radar.platform.velocity_mps=[0, 0, -1000]"});
  expect_refused(map_of(folder.path() / "map.png", more),
                 "radar.platform.velocity_mps: value -1000 upwards: the radar sinks 64 m in an interval, "
                 "must be less than its height, 34.91 m, with sea_reflection");
}

TEST(MapCommand, WarnsAboutPointsOutsideTheMap) {
  const TemporaryFolder folder;
  const Words more = with(kOnePoint, {"--set", "map.velocity_span_mps=2"});
  EXPECT_THAT(completed(map_of(folder.path() / "map.svg", more)).err,
              HasSubstr("moves at -1.50 to 0.00 m/s, the map shows"));
}

// Range, velocity and amplitude of the listed centres.
std::vector<std::array<double, 3>> cluster_centres(const Words& more) {
  const TemporaryFolder folder;
  const ProgramResult result = completed(map_of(folder.path() / "map.png", more));
  std::istringstream lines(result.out);
  std::string header;
  std::getline(lines, header);
  std::vector<std::array<double, 3>> centres;
  for (std::array<double, 3> c{}; lines >> c[0] >> c[1] >> c[2];) centres.push_back(c);
  return centres;
}

TEST(MapCommand, ACompanionIsInTheSameMap) {
  const std::string targets =
      "targets={one: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1, 0, 0]}], "
      "companions: [{target: other, x_m: -50, y_m: 8}]}, other: {label: 0, points: [{position_m: [5, 0, 0]}]}}";
  const auto centres_in = [&](const std::string& sample) {
    return cluster_centres({"--set", "view={azimuth_deg: 0, elevation_deg: 0}", "--set", targets, "--set",
                            "dataset={maps_per_case: 1, realisations_per_case: 1}", "--set", "clutter.scr_db=60",
                            "--sample", sample});
  };
  // Which of the two targets sample 0 contains is random; the companion is placed with one of them.
  const auto first = centres_in("0"), second = centres_in("1");
  const auto& both = first.size() > second.size() ? first : second;
  const auto& alone = first.size() > second.size() ? second : first;
  ASSERT_EQ(both.size(), 2u);
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_NEAR(both[0][0], -30, 0.02);
  EXPECT_NEAR(both[0][1], -1, 0.005);
  EXPECT_NEAR(both[1][0], 45, 0.02);
  EXPECT_NEAR(both[1][2], 1, 0.02);
  EXPECT_NEAR(alone[0][0], -5, 0.02);
}

// A ship at 2 m/s, viewed from 60 deg off the bow: floats and ideal points, which stay in the water, drift astern at 2
// cos 60 = 1 m/s; another ship of the same speed keeps its position.
TEST(MapCommand, CompanionsOfAShipUnderWayStayInTheWater) {
  const std::string corner = "mesh: assets/icosahedral_reflector.glb", hull = "length_m: 140, beam_m: 19, draught_m: 6";
  const auto centres = [&](const std::string& with) {
    const std::string targets = fmt::format(
        "targets={{flagship: {{label: 1, {0}, motion: {{model: ship, speed_mps: 2, {1}}}, companions: [{2}]}}, "
        "consort: {{label: 1, {0}, motion: {{model: ship, speed_mps: 2, {1}}}}}, "
        "decoy: {{label: 0, {0}, motion: {{model: float}}}}, "
        "buoy: {{label: 0, points: [{{position_m: [0, 0, 0], amplitude_m: 4}}]}}}}",
        corner, hull, with);
    std::vector<std::array<double, 3>> most;
    for (const char* sample : {"0", "1", "2", "3"}) {
      const auto found = cluster_centres({"--set", "view={azimuth_deg: 60, elevation_deg: 0}", "--set",
                                          "sea={significant_wave_height_m: 0}", "--set", targets, "--set",
                                          "dataset={maps_per_case: 1, realisations_per_case: 1}", "--set",
                                          "clutter.enabled=false", "--sample", sample});
      if (found.size() > most.size()) most = found;
    }
    return most;
  };
  // Velocity of the strongest centre within a metre of the range of a companion at x = -80 m.
  const auto velocity_at_40_m = [&](const std::string& companion) {
    std::array<double, 3> strongest{0, 99, 0};
    for (const auto& centre : centres("{target: " + companion + ", x_m: -80}")) {
      if (std::abs(centre[0] - 40) < 1 && centre[2] > strongest[2]) strongest = centre;
    }
    return strongest[1];
  };
  EXPECT_NEAR(velocity_at_40_m("decoy"), 1, 0.0146);  // a tenth of a cell
  EXPECT_NEAR(velocity_at_40_m("buoy"), 1, 0.0146);
  EXPECT_NEAR(velocity_at_40_m("consort"), 0, 0.0146);
}

TEST(MapCommand, PlatformMotionIsVisibleUnlessCompensated) {
  const Words moving = with(
      kOnePoint,
      {"--set", "radar.platform={velocity_mps: [2.5, 0, 0], motion_compensated: false}", "--set", "clutter.scr_db=60"});
  const auto detected = cluster_centres(moving);
  ASSERT_GE(detected.size(), 1u);
  EXPECT_NEAR(detected[0][1], -1.5 + 2.5, 0.005);  // the radar ahead recedes
  EXPECT_NEAR(detected[0][0], -30, 0.02);
  EXPECT_NEAR(cluster_centres(with(moving, {"--set", "radar.platform.motion_compensated=true"}))[0][1], -1.5, 0.005);
}

// `seaglint echo`: the samples that NumPy reads are the chirp of the scenario, delayed by the point's range.

// One point of 2 m, 30 m nearer than the reference point, approaching at 1.5 m/s.
std::vector<std::string> echo_of(const std::string& output, Words more = {}) {
  return with(
      {"echo", "scenarios/points.yaml", "-o", output, "--set", "view={azimuth_deg: 0, elevation_deg: 0}", "--set",
       "targets={line: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.5, 0, 0]}]}}"},
      more);
}

TEST(EchoCommand, WritesSamplesThatNumpyCompressesToThePoint) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "echo.npz";
  EXPECT_THAT(completed(echo_of(file)).out, HasSubstr("256 pulses of"));
  if (run_words({kPython, "-c", "import numpy"}).code != 0) GTEST_SKIP() << "needs the package python3-numpy";
  // Correlates pulses with the ideal chirp, delayed, and removes the carrier's phase of the point's range.
  const ProgramResult read = completed(run_words({kPython, "-c", R"(
import sys, numpy as np
a = np.load(sys.argv[1])
c, mu, width = 299792458.0, 25e6 / 36e-6, 36e-6
t = a['time_s']
def correlation(n, r):
    u = t - 2 * r / c
    return np.vdot(np.where(abs(u) < width / 2, np.exp(1j * np.pi * mu * u * u), 0), a['target'][n]) / (width * 50e6)
ranges = np.arange(-60, 60, 0.25)
best = ranges[np.argmax([abs(correlation(0, r)) for r in ranges])]
assert abs(best + 30) <= 0.5, best
for n in (0, 100, 255):
    r = -30 - 1.5 * a['pulse_time_s'][n]
    z = correlation(n, r) * np.exp(4j * np.pi * a['carrier_hz'][n] * r / c)
    assert abs(z - 2) < 0.04, z   # the ideal chirp has a few percent of its energy beyond the band
assert a['clutter'].shape == a['noise'].shape == a['target'].shape
print('point found')
)",
                                                  file}));
  EXPECT_EQ(read.out, "point found\n");
}

TEST(EchoCommand, RefusesSamplesThatDoNotExist) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_program(map_of(folder.path() / "map.png", {"--sample", "1000000"})).code, 2);
  expect_refused(echo_of(folder.path() / "echo.npz", {"--sample", "1000000"}),
                 "--sample 1000000: the scenario has samples 0 to");
}

TEST(EchoCommand, RefusesMoreSamplesThanFitIntoMemory) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "echo.npz";
  expect_refused(echo_of(file, {"--set", "radar.pulses=65536", "--set", "radar.sampling_mhz=1000"}),
                 "--set radar.pulses: value 65536: with 38280 samples of each pulse at most 3506 "
                 "pulses make an echo");
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// `seaglint echo`: the samples that NumPy reads are the chirp of the scenario, delayed by the point's range.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

using ::testing::HasSubstr;

// One point of 2 m, 30 m nearer than the reference point, approaching at 1.5 m/s.
std::vector<std::string> echo_of(const std::string& output, std::vector<std::string> more = {}) {
  std::vector<std::string> words{
      "echo",
      "scenarios/points.yaml",
      "-o",
      output,
      "--set",
      "view={azimuth_deg: 0, elevation_deg: 0}",
      "--set",
      "targets={line: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.5, 0, 0]}]}}"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(EchoCommand, WritesSamplesThatNumpyCompressesToThePoint) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "echo.npz";
  const ProgramResult result = run_program(echo_of(file));
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("256 pulses of"));
  if (run_words({kPython, "-c", "import numpy"}).code != 0) GTEST_SKIP() << "needs the package python3-numpy";
  // Correlates pulses with the ideal chirp, delayed, and removes the carrier's phase of the point's range.
  const ProgramResult read = run_words({kPython, "-c", R"(
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
                                        file});
  EXPECT_EQ(read.code, 0) << read.err;
  EXPECT_EQ(read.out, "point found\n");
}

TEST(EchoCommand, RefusesSamplesThatDoNotExist) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(echo_of(folder.path() / "echo.npz", {"--sample", "1000000"}));
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--sample 1000000: the scenario has samples 0 to"));
}

TEST(EchoCommand, RefusesMoreSamplesThanFitIntoMemory) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "echo.npz";
  const ProgramResult result =
      run_program(echo_of(file, {"--set", "radar.pulses=65536", "--set", "radar.sampling_mhz=1000"}));
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--set radar.pulses: value 65536: with 38280 samples of each pulse at most 3506 "
                                    "pulses make an echo"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// `seaglint classify MODEL ECHO.npz`: an echo over time has the features and probabilities of its sample in the data
// set, to rounding without noise and within the noise with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "sim/core/numbers/constants.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr const char* kFaintNoise = "clutter.cnr_db=200";  // 140 dB below the rounding of single precision
// Two points of one amplitude, receding at +-1.2 m/s, as near to each other as to a line.
constexpr const char* kTwoPoints =
    "targets={pair: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.2, 0, 0]}, "
    "{position_m: [-30, 0, 0], amplitude_m: 2, velocity_mps: [-1.2, 0, 0]}]}, reflectors: {label: 0, points: "
    "[{position_m: [0, 0, 0]}]}}";

class EchoOverTime : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    run({"generate", "scenarios/points.yaml", "-o", path("data"), "--set", kFaintNoise});
    run({"train", path("data"), "-o", path("model"), "--set", "learning.epochs=2", "--set", "learning.trees=20"});
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string path(const std::string& name) { return folder_->path() / name; }

  static std::string run(const Words& words) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 0) << testing::PrintToString(words) << result.err;
    return result.out;
  }

  // The echo of a sample of points.yaml with these settings.
  static std::string echo(int sample, const Words& settings) {
    std::string file = path("echo.npz");
    Words words{"echo", "scenarios/points.yaml", "--sample", std::to_string(sample), "-o", file};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    run(words);
    return file;
  }

  // Cells of the only line of the table of `classify`.
  static std::vector<std::string> classified(const Words& what) {
    Words words{"classify", path("model")};
    words.insert(words.end(), what.begin(), what.end());
    words.insert(words.end(), {"-o", path("one.csv")});
    run(words);
    std::istringstream lines(read_file(path("one.csv")));
    std::string line;
    std::getline(lines, line);
    EXPECT_THAT(line, HasSubstr("sample,label,probability_handmade,probability_cnn,probability_fused,probability_"
                                "extended,mwr,ccf,sigma_r_m,sigma_v_mps,outside"));
    std::getline(lines, line);
    std::istringstream cells(line + " ");
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    EXPECT_EQ(values.size(), 11u);
    return values;
  }

  static void expect_refusal(const Words& words, const std::string& message) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 2) << result.out;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }

  static inline TemporaryFolder* folder_ = nullptr;
};

// Samples of an echo are rounded to 24 bits, of the largest amplitude of all points, 8 m, relative to the smallest one
// that is a centre, some 1 m: 5e-7 of a cell at each centre, which the residuals of mwr, a tenth of a cell and more,
// have five times. Single precision of the stored features adds 6e-8.
TEST_F(EchoOverTime, HasTheFeaturesAndProbabilitiesOfItsSampleToRounding) {
  double most = 0;
  for (const int sample : {0, 3, 17, 39}) {
    const std::vector<std::string> of_set = classified({path("data"), "--sample", std::to_string(sample)});
    const std::vector<std::string> of_echo = classified({echo(sample, {kFaintNoise})});
    EXPECT_EQ(of_echo[0], std::to_string(sample));
    for (const std::size_t cell : {0, 1, 2, 3, 4, 5, 10})
      EXPECT_EQ(of_echo[cell], of_set[cell]) << sample << " " << cell;
    for (std::size_t cell = 6; cell < 10; ++cell)
      most = std::max(most, std::abs(std::stod(of_echo[cell]) / std::stod(of_set[cell]) - 1));
  }
  std::printf("features of an echo over time, largest relative difference: %.1e\n", most);
  EXPECT_LT(most, 5e-6);
  // The text is that of the sample of the data set: conditions and measured ratios too.
  EXPECT_EQ(run({"classify", path("model"), echo(5, {kFaintNoise})}),
            run({"classify", path("model"), path("data"), "--sample", "5"}));
}

// Cramer and Rao's bound of a tone's frequency (Rife and Boorstyn 1974): the velocity of a point that is `snr` above
// the noise in its cell has the standard error sqrt(6 / snr) / (2 pi) of a cell of lambda/(2 N T_r), here 0.146 m/s.
// Each of both points has half of the power, Hann's taper in range costs 1.76 dB, and 256 pulses of 33 frequencies are
// summed. sigma_v is half of the difference of both velocities; of two independent noises the difference has sqrt(2) of
// that.
TEST_F(EchoOverTime, WithNoiseDiffersByTheBoundOfCramerAndRao) {
  const Words settings{kTwoPoints, "clutter={enabled: false, noise_level: snr, snr_db: -5}", "view.azimuth_deg=0"};
  Words words{"generate", "scenarios/points.yaml", "-o", path("noisy")};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  run(words);
  const double cell_mps = kSpeedOfLight / 16.0875e9 / (2 * 256 * 250e-6);
  const double snr = std::pow(10, -0.5) * 256 * 33 / 2 / std::pow(10, 0.176);
  const double standard_error = std::sqrt(6 / snr) / (2 * kPi) * cell_mps;
  double squares = 0;
  int count = 0;
  for (int sample = 0; sample < 12; ++sample) {
    const std::vector<std::string> of_set = classified({path("noisy"), "--sample", std::to_string(sample)});
    if (of_set[1] != "1") continue;
    const std::vector<std::string> of_echo = classified({echo(sample, settings)});
    const double difference = std::stod(of_echo[9]) - std::stod(of_set[9]);
    EXPECT_NE(difference, 0) << "one realisation of the noise";
    squares += difference * difference;
    ++count;
  }
  ASSERT_EQ(count, 6);
  const double ratio = std::sqrt(squares / count) / standard_error;
  std::printf("sigma_v, root mean square difference over Cramer and Rao's bound, %d echoes: %.2f\n", count, ratio);
  EXPECT_GT(ratio, 0.25);
  EXPECT_LT(ratio, 2.2);
}

TEST_F(EchoOverTime, ThatDoesNotFitIsRefused) {
  const std::string file = echo(0, {kFaintNoise});
  expect_refusal({"classify", path("model"), file, "--sample", "0"}, "is the echo of one interval");
  const std::string bytes = read_file(file);
  write_file(path("half.npz"), bytes.substr(0, bytes.size() / 2));
  expect_refusal({"classify", path("model"), path("half.npz")}, "half.npz: no .npz archive of NumPy, or truncated");
  const ProgramResult compressed = run_words({kPython, "-c", R"(
import sys, zipfile
with zipfile.ZipFile(sys.argv[1]) as stored, zipfile.ZipFile(sys.argv[2], 'w', zipfile.ZIP_DEFLATED) as archive:
    for name in stored.namelist():
        archive.writestr(name, stored.read(name))
)",
                                              file, path("compressed.npz")});
  ASSERT_EQ(compressed.code, 0) << compressed.err;
  expect_refusal({"classify", path("model"), path("compressed.npz")},
                 "array pulse_time_s: is compressed; numpy.savez writes archives that are not");
  expect_refusal({"classify", path("model"), path("none.npz")}, "none.npz: no such file");
  run({"export", path("data"), "-o", path("set.npz")});
  expect_refusal({"classify", path("model"), path("set.npz")}, "set.npz: ");
  expect_refusal({"classify", path("model"), echo(0, {"features.max_centres=32"})},
                 "echo.npz: features of other settings: features.max_centres: 32 instead of 64");
  expect_refusal({"classify", path("model"), echo(0, {"radar.pulses=128"})}, "echo.npz: maps of another grid");
}

}  // namespace
}  // namespace seaglint

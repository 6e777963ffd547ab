// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/recorded/attitude_series.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "sim/core/numbers/constants.h"
#include "sim/motion/statistics.h"
#include "sim/motion/target_motion.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

// In a folder of this process, since tests of other processes write files of the same names.
std::filesystem::path write(const std::string& text, const char* name = "series.csv") {
  static const TemporaryFolder folder;
  std::filesystem::path file = folder.path() / name;
  std::ofstream(file) << text;
  return file;
}

// A ship's roll and pitch as two programs would write them, 100 s at 0.1 s.
struct Wave {
  double roll(double t) const { return 3 * std::sin(0.6 * t); }
  double pitch(double t) const { return 0.8 * std::cos(0.9 * t + 1); }
  double pitch_rate(double t) const { return -0.72 * std::sin(0.9 * t + 1); }
  double heave(double t) const { return 0.5 * std::sin(0.7 * t); }
};
constexpr int kRows = 1001;

void expect_wave(const AttitudeSeries& series, bool shifts) {
  const Wave wave;
  ASSERT_EQ(series.time.size(), static_cast<std::size_t>(kRows));
  for (std::size_t n = 20; n + 20 < series.time.size(); n += 50) {
    const double t = series.time[n];
    EXPECT_NEAR(degrees(series.samples[n].angles.x()), wave.roll(t), 1e-5);
    EXPECT_NEAR(degrees(series.samples[n].angles.y()), wave.pitch(t), 1e-5);
    EXPECT_NEAR(degrees(series.samples[n].angle_rates.y()), wave.pitch_rate(t), 2e-4);
    EXPECT_NEAR(series.samples[n].translation.z(), shifts ? wave.heave(t) : 0, 1e-5);
  }
}

TEST(AttitudeSeries, AreReadFromThisProgramsTables) {
  const Wave wave;
  std::string in_degrees = "# a comment\ntime_s,roll_deg,pitch_deg,yaw_deg\n";
  std::string in_radians = "time_s,body,roll_rad,pitch_rad,yaw_rad,surge_m,sway_m,heave_m\n";
  for (int n = 0; n < kRows; ++n) {
    const double t = 0.1 * n;
    in_degrees += fmt::format("{:.9g},{:.9g},{:.9g},0\n", t, wave.roll(t), wave.pitch(t));
    in_radians += fmt::format("{:.9g},ship,{:.9g},{:.9g},0,0,0,{:.9g}\n", t, radians(wave.roll(t)),
                              radians(wave.pitch(t)), wave.heave(t));
  }
  expect_wave(read_attitude_series(write(in_degrees)), false);
  expect_wave(read_attitude_series(write(in_radians)), true);
}

// Comments may contain any words, also those by which the kinds of tables are distinguished.
TEST(AttitudeSeries, AreDistinguishedByTheirColumnNames) {
  for (const char* comment : {"night_time_sea", "roll [deg]", "PtfmRoll"}) {
    const AttitudeSeries series = read_attitude_series(write(
        std::string("\n# scenario ") + comment +
        "\n  # time_s\ntime_s,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m\n0,1,2,3,4,5,6\n1,1,2,3,4,5,6\n"));
    EXPECT_EQ(series.samples.front().translation, Vec3(4, 5, 6)) << comment;
  }
}

// The header as DualSPHysics' FloatingInfo writes it; pitch of either sign with the same angular velocity.
TEST(AttitudeSeries, AreReadFromFloatingInfoWithEitherSignOfPitch) {
  const Wave wave;
  for (const double sign : {1.0, -1.0}) {
    std::string text =
        "time [s];fvel.x [m/s];fvel.y [m/s];fvel.z [m/s];fomega.x [rad/s];fomega.y [rad/s];fomega.z [rad/s];"
        "center.x [m];center.y [m];center.z [m];surge [m];sway [m];heave [m];roll [deg];pitch [deg];yaw [deg]\n";
    for (int n = 0; n < kRows; ++n) {
      const double t = 0.1 * n;
      text += fmt::format("{:.6f};0;0;0;0;{:.8f};0;0;0;0;0;0;{:.8f};{:.8f};{:.8f};0\n", t, radians(wave.pitch_rate(t)),
                          wave.heave(t), wave.roll(t), sign * wave.pitch(t));
    }
    expect_wave(read_attitude_series(write(text)), true);
  }
}

TEST(AttitudeSeries, AreReadFromOpenFast) {
  const Wave wave;
  for (const char* unit : {"(deg)", "(rad)"}) {
    const double scale = std::string(unit) == "(deg)" ? 1 : radians(1);
    std::string text =
        "\nPredictions were generated on 01-Jan-2024 using OpenFAST\n linked with ElastoDyn\n\nDescription line\n\n";
    text += "Time\tWave1Elev\tPtfmSurge\tPtfmSway\tPtfmHeave\tPtfmRoll\tPtfmPitch\tPtfmYaw\n";
    text += fmt::format("(s)\t(m)\t(m)\t(m)\t(m)\t{0}\t{0}\t{0}\n", unit);
    for (int n = 0; n < kRows; ++n) {
      const double t = 0.1 * n;
      text += fmt::format("{:10.4f}\t0\t0\t0\t{:13.8e}\t{:13.8e}\t{:13.8e}\t0\n", t, wave.heave(t),
                          scale * wave.roll(t), scale * wave.pitch(t));
    }
    expect_wave(read_attitude_series(write(text, "openfast.out")), true);
  }
  EXPECT_HAS(
      refusal_of([] {
        read_attitude_series(write("Time PtfmRoll PtfmPitch PtfmYaw\n(s) (grad) (deg) (deg)\n0 0 0 0\n1 0 0 0\n"));
      }),
      "unit '(grad)' of PtfmRoll");
}

constexpr const char* kCases = SEAGLINT_SOURCE_DIR "/tests/cases/tables/";

// Byte order mark, separators, decimal commas, and another program's columns.
TEST(AttitudeSeries, AreTheSameFromEverySystem) {
  const AttitudeSeries plain = read_attitude_series(std::string(kCases) + "series_bom.csv");
  ASSERT_GT(plain.time.size(), 30u);
  for (const char* name : {"series_semi.csv", "series_semicomma.csv", "series_tab.csv", "dualsphysics_csvsep1.csv"}) {
    const AttitudeSeries series = read_attitude_series(std::string(kCases) + name);
    EXPECT_EQ(series.time, plain.time) << name;
    ASSERT_EQ(series.samples.size(), plain.samples.size()) << name;
    for (std::size_t n = 0; n < series.samples.size(); ++n)
      EXPECT_EQ(series.samples[n].angles, plain.samples[n].angles) << name << " " << n;
  }
  const AttitudeSeries quoted =
      read_attitude_series(write("\"time\";\"roll\";\"pitch\";\"yaw\"\r\n\"s\";\"deg\";\"deg\";\"deg\"\r\n0,0;\"0,"
                                 "591040\";0;0\r\n0,05;\"0,665597\";"
                                 "\"0,052336\";\"0,014278\"\r\n"));
  EXPECT_EQ(quoted.samples[1].angles, plain.samples[1].angles);
}

// Roll 2 sin(2 pi t / 8 s + 0.3) deg, written at 30 Hz with two decimals of the time and four of the angle. The slope
// of a spline through values with an error e is wrong by 3 e / step at most.
TEST(AttitudeSeries, WithRoundedTimesAreUniform) {
  const AttitudeSeries series = read_attitude_series(std::string(kCases) + "times_of_two_decimals_30hz.csv");
  EXPECT_EQ(series.grid, TimeGrid::kRounded);
  EXPECT_HAS(series.reading, "times rounded to 0.01 s taken as uniform at 0.0333");
  for (std::size_t n = 1; n < series.time.size(); ++n)
    EXPECT_NEAR(series.time[n] - series.time[n - 1], 1.0 / 30, 0.01 / 398) << n;  // the rounding of both ends
  // Rounding of the angles, and of the first and last time.
  const double slope_error = 3 * 5e-5 * 30 + 2 * 2 * kPi / 8 * 0.01 / series.time.back();
  for (std::size_t n = 0; n < series.time.size(); n += 10) {
    const double phase = 2 * kPi * series.time[n] / 8 + 0.3;
    EXPECT_NEAR(degrees(series.samples[n].angle_rates.x()), 2 * 2 * kPi / 8 * std::cos(phase), slope_error) << n;
  }
  // One of 81 samples, the end of the period, counts twice. Resampled as they are, the times give 6.6 s.
  const Trajectory trajectory = trajectory_of(series, 0, 8, false, Vec3::Zero(), Vec3::Zero());
  EXPECT_NEAR(angle_statistics(trajectory, 8)[0].mean_period_s, 8, 8.0 / 81);
  // Times off the grid by more than their rounding are resampled as they are.
  std::string text = "time_s,roll_deg,pitch_deg,yaw_deg\n";
  for (int n = 0; n < 100; ++n) text += fmt::format("{:.2f},{},0,0\n", n / 30.0 + (n == 50 ? 0.015 : 0), n % 7);
  const AttitudeSeries irregular = read_attitude_series(write(text));
  EXPECT_EQ(irregular.grid, TimeGrid::kIrregular);
  EXPECT_HAS(irregular.reading, "times are not uniform");
}

TEST(TimeGrid, IsFoundWhereverItsFirstTimeIsRounded) {
  for (const double rate : {24.0, 25.0, 29.97, 30.0, 48.0, 59.94}) {
    for (const double begin : {0.0, 0.0049, 123.4567, -7.001}) {
      std::vector<double> time;
      for (int n = 0; n < 500; ++n) time.push_back(std::round(100 * (begin + n / rate)) / 100);
      const double first = time.front(), last = time.back();
      const TimeGrid grid = make_uniform(time, 0.005);
      EXPECT_EQ(grid, rate == 25 ? TimeGrid::kUniform : TimeGrid::kRounded) << rate << " " << begin;
      EXPECT_EQ(time.front(), first);
      EXPECT_EQ(time.back(), last);
      for (int n = 0; n < 500; ++n) EXPECT_NEAR(time[static_cast<std::size_t>(n)], begin + n / rate, 0.0051);
    }
  }
}

// A third of the Nyquist frequency of the series, given at uniform and at non-uniform times: read at ten times as many
// it has the same variance, and negligible energy above the Nyquist frequency.
TEST(TrajectoryOf, AddsNoEnergy) {
  for (const double jitter : {0.0, 0.3}) {
    AttitudeSeries series{"test", {}, {}};
    std::string text = "time_s,roll_deg,pitch_deg,yaw_deg\n";
    const double step = 0.5, omega = kPi / step / 3;
    for (int n = 0; n <= 2000; ++n) {
      const double t = step * (n + jitter * std::sin(12.9898 * n));
      text += fmt::format("{:.10g},{:.10g},{:.10g},0\n", t, std::sin(omega * t), std::sin(0.2 * omega * t));
    }
    const Trajectory trajectory =
        trajectory_of(read_attitude_series(write(text)), 0, 990, false, Vec3::Zero(), Vec3::Zero());
    double fast = 0, slow = 0, above = 0;
    Complex image = 0;
    const int count = 19800;
    for (int n = 0; n < count; ++n) {
      const double t = 5 + 0.05 * n * 975 / 990;
      const Vec3 angles = trajectory.sample(t).angles * degrees(1);
      fast += angles.x() * angles.x() / count;
      slow += angles.y() * angles.y() / count;
      // The image of omega on the other side of the sampling frequency.
      image += 2.0 * angles.x() * std::polar(1.0, (2 * kPi / step - omega) * t) / double(count);
    }
    above = 0.5 * std::norm(image);
    EXPECT_LE(fast, 0.5 * 1.002) << jitter;
    // A cubic spline passes 0.994 of an amplitude at a third of its band; non-uniform times reduce it a little.
    EXPECT_NEAR(fast, 0.5, 0.5 * (jitter > 0 ? 0.03 : 0.015)) << jitter;
    EXPECT_NEAR(slow, 0.5, 0.5 * 2e-3) << jitter;
    EXPECT_LT(above, 0.5 * 1e-3) << jitter;
  }
}

TEST(AttitudeSeries, ReportErrorsOfTheirTimes) {
  const char* head = "time_s,roll_deg,pitch_deg,yaw_deg\n";
  const auto read = [&](const std::string& rows) {
    return refusal_of([&] { read_attitude_series(write(head + rows)); });
  };
  EXPECT_HAS(read("0,0,0,0\n0.1,0,0,0\n0.1,0,0,0\n"), "series.csv:4:1: time_s: value '0.1': must be greater");
  EXPECT_HAS(read("0,0,0,0\n0.2,0,0,0\n0.1,0,0,0\n"), "series.csv:4:1: time_s: value '0.1': must be greater");
  EXPECT_HAS(read("0,0,0,0\n1,0,0,0\n2,0,0,0\n3,0,0,0\n60,0,0,0\n"), "a gap of 57 s");
  EXPECT_HAS(read("0,0,0,0\n"), "1 rows of numbers");
  EXPECT_HAS(read("0,0,0,0\n1,nan,0,0\n"), "series.csv:3:3: roll_deg: value 'nan'");
  EXPECT_HAS(read("0,0,0,0\n1,,0,0\n"), "must be a finite number");
  EXPECT_HAS(read("0,0,0,0\n1,0,0\n"), "3 cells where the names are 4");
  EXPECT_HAS(refusal_of([] { read_attitude_series(write("time_s,roll_deg,yaw_deg\n0,0,0\n1,0,0\n")); }),
             "no column pitch_deg; the columns are time_s, roll_deg, yaw_deg");
  EXPECT_HAS(refusal_of([] { read_attitude_series(write("")); }), "0 rows");
}

TEST(AttitudeSeries, ReportDegreesWhereRadiansAreDeclared) {
  std::string all = "time_s,roll_rad,pitch_rad,yaw_rad\n", half = all;
  for (int n = 0; n < 400; ++n) {
    const double roll = 0.1 * std::sin(0.06 * n);
    all += fmt::format("{:.3f},{:.6f},0,0\n", 0.1 * n, degrees(roll));
    half += fmt::format("{:.3f},{:.6f},0,0\n", 0.1 * n, n < 226 ? roll : degrees(roll));
  }
  EXPECT_HAS(refusal_of([&] { read_attitude_series(write(all)); }),
             "degrees where radians are declared, 57 times too large");
  const std::string message = refusal_of([&] { read_attitude_series(write(half)); });
  EXPECT_HAS(message, "series.csv:228:8: roll_rad");
  EXPECT_HAS(message, "a 57-fold jump from 0.080378, as between radians and degrees");
}

// A series with yaw about `heading_deg`, written in [0, 360), for 120 s; x and y of the file are the translations.
std::string series_about(double heading_deg, const char* translations = "", double begin_s = 0) {
  std::string text =
      fmt::format("time_s,roll_deg,pitch_deg,yaw_deg{}\n", *translations ? ",surge_m,sway_m,heave_m" : "");
  for (int n = 0; n <= 1200; ++n) {
    const double t = 0.1 * n, yaw = heading_deg + 2 * std::sin(2 * kPi * t / 20);
    text += fmt::format("{:.1f},{:.6f},{:.6f},{:.6f}", begin_s + t, 3 * std::sin(0.6 * t), 0.8 * std::cos(0.9 * t),
                        yaw - 360 * std::floor(yaw / 360));
    text += std::string(translations) + "\n";
  }
  return text;
}

void expect_equal_angles(const AttitudeSeries& a, const AttitudeSeries& b, double tolerance) {
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t n = 0; n < a.samples.size(); ++n) {
    EXPECT_LT((a.samples[n].angles - b.samples[n].angles).norm(), tolerance) << n;
    EXPECT_LT((a.samples[n].angle_rates - b.samples[n].angle_rates).norm(), 100 * tolerance) << n;
  }
}

// The frame T has the mean heading: a compass heading gives the motion of the same series about 0. Its digits differ by
// 1e-6 deg.
TEST(AttitudeSeries, HaveTheirMeanHeadingAlongX) {
  const AttitudeSeries about_0 = read_attitude_series(write(series_about(0)));
  EXPECT_THAT(about_0.reading, testing::Not(testing::HasSubstr("heading")));
  for (const double heading_deg : {271.0, 90.0, 180.0, 354.5, 7.0}) {
    const AttitudeSeries turned = read_attitude_series(write(series_about(heading_deg)));
    expect_equal_angles(turned, about_0, 1e-7);
    EXPECT_HAS(turned.reading, fmt::format("mean heading {:.4g} deg removed", heading_deg));
  }
  const auto read = [](double heading_deg, MeanRule rule) {
    return read_attitude_series(write(series_about(heading_deg)), {.heading = rule});
  };
  const AttitudeSeries kept = read(271, MeanRule::kKeep);
  EXPECT_NEAR(degrees(kept.samples[0].angles.z()), 271, 1e-9);
  EXPECT_HAS(kept.reading, "mean heading 271 deg kept");
  // Within 5 deg a mean may be that of a short window of a series about 0.
  const AttitudeSeries near = read(3, MeanRule::kAuto);
  EXPECT_NEAR(degrees(near.samples[0].angles.z()), 3, 1e-9);
  EXPECT_HAS(near.reading, "mean heading 3 deg kept");
  expect_equal_angles(read(3, MeanRule::kRemove), about_0, 1e-7);
}

// A yaw that turns through a full circle has no mean.
TEST(AttitudeSeries, ThatTurnHaveNoMeanHeading) {
  std::string text = "time_s,roll_deg,pitch_deg,yaw_deg\n";
  for (int n = 0; n <= 360; ++n) text += fmt::format("{},0,0,{}\n", n, n % 360);
  const AttitudeSeries series = read_attitude_series(write(text));
  EXPECT_NEAR(degrees(series.samples[90].angles.z()), 90, 1e-9);
  EXPECT_HAS(series.reading, "yaw turns too far for a mean heading");
}

// Positions of a map: their mean is no part of the motion; x of the file at heading 90 deg is to starboard of T.
TEST(AttitudeSeries, HaveTheirMeanPositionAtTheOrigin) {
  std::string text = "time_s,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m\n";
  for (int n = 0; n <= 400; ++n)
    text += fmt::format("{:.1f},1,0,90,{:.3f},5871200.20,45.5\n", 0.1 * n, 412300 + 0.02 * n);
  const AttitudeSeries series = read_attitude_series(write(text));
  EXPECT_HAS(series.reading,
             "mean position (412304.0, 5871200.2) m removed, mean heave 45.5 m "
             "removed, mean heading 90 deg removed, surge and sway turned with it");
  EXPECT_LT((series.samples.front().translation - Vec3(0, 4, 0)).norm(), 1e-6);
  EXPECT_LT((series.samples.back().translation - Vec3(0, -4, 0)).norm(), 1e-6);
  const AttitudeSeries kept =
      read_attitude_series(write(text), {.heading = MeanRule::kKeep, .position = MeanRule::kKeep});
  EXPECT_EQ(kept.samples.front().translation, Vec3(412300, 5871200.20, 45.5));
  EXPECT_HAS(kept.reading, "mean position (412304.0, 5871200.2) m kept");
  // A moored body's offset is no position of a map.
  const AttitudeSeries moored = read_attitude_series(write(series_about(0, ",12,-3,0.4")));
  EXPECT_EQ(moored.samples[5].translation, Vec3(12, -3, 0.4));
}

TEST(AttitudeSeries, MayBeInUnixSeconds) {
  const AttitudeSeries plain = read_attitude_series(write(series_about(0))),
                       unix = read_attitude_series(write(series_about(0, "", 1735689600)));
  expect_equal_angles(unix, plain, 1e-5);  // the steps have a rounding of 2.4e-7 s
  const Trajectory trajectory = trajectory_of(unix, 1735689610, 20, false, Vec3::Zero(), Vec3::Zero());
  EXPECT_NEAR(degrees(trajectory.sample(0).angles.x()), 3 * std::sin(6), 1e-4);
  EXPECT_HAS(refusal_of([&] { trajectory_of(unix, 0, 20, false, Vec3::Zero(), Vec3::Zero()); }),
             "lasts from 1735689600 to 1735689720 s, 0 to 20 s are needed: motion.series_start_s, "
             "now 0, is the time of the file that is t = 0; its first is 1735689600");
}

TEST(AttitudeSeries, MayLackDegreesOfFreedomOtherThanRollAndPitch) {
  const AttitudeSeries series =
      read_attitude_series(write("time_s,roll_deg,pitch_deg,heave_m\n0,1,2,0.5\n1,3,4,0.6\n"));
  EXPECT_EQ(series.samples[1].translation, Vec3(0, 0, 0.6));
  EXPECT_NEAR(degrees(series.samples[1].angles.x()), 3, 1e-12);
  EXPECT_EQ(series.samples[1].angles.z(), 0);
  EXPECT_HAS(series.reading, "yaw and surge and sway not in the file: 0");
  // Without translations they are not needed.
  EXPECT_HAS(read_attitude_series(write("time_s,roll_deg,pitch_deg\n0,1,2\n1,3,4\n"), {.translations = false}).reading,
             "yaw not in the file: 0");
  // A column in another unit is not one that is missing.
  EXPECT_HAS(refusal_of([] { read_attitude_series(write("time_s,roll_deg,pitch_deg,yaw\n0,1,2,3\n1,3,4,5\n")); }),
             "series.csv:1:27: yaw has no unit: must be named yaw_deg or yaw_rad");
  const std::string feet = "time_s,roll_deg,pitch_deg,heave [ft]\n0,1,2,3\n1,3,4,5\n";
  EXPECT_HAS(refusal_of([&] { read_attitude_series(write(feet)); }),
             "series.csv:1:27: unit '[ft]' of heave [ft]: must be m");
  EXPECT_EQ(refusal_of([&] { read_attitude_series(write(feet), {.translations = false}); }), "accepted");
}

// OpenFAST writes INVALID for the unit of a channel that it does not have.
TEST(AttitudeSeries, OfOpenFastMayHaveInvalidChannels) {
  const AttitudeSeries series = read_attitude_series(std::string(kCases) + "openfast_invalid_channel.out");
  EXPECT_EQ(series.time.size(), 44u);
  EXPECT_NEAR(degrees(series.samples[1].angles.x()), 0.1398857, 1e-12);
  EXPECT_NEAR(series.samples[1].translation.z(), 0.03993337, 1e-12);
  const std::string banner = "\nPredictions were generated on 05-May-2025 at 08:00:00 using OpenFAST\n\nA barge\n\n";
  EXPECT_HAS(refusal_of([&] {
               read_attitude_series(write(banner + "Time PtfmRoll PtfmPitch PtfmYaw\n(s) INVALID (deg) (deg)\n0 0 0 "
                                                   "0\n1 0 0 0\n"));
             }),
             "series.csv:6:6: unit 'INVALID' of PtfmRoll: must be deg or rad");
}

// Minus signs and blanks of typesetting.
TEST(AttitudeSeries, MayHaveTypesetSigns) {
  const AttitudeSeries series =
      read_attitude_series(write("time_s;roll_deg;pitch_deg;yaw_deg\n0;\xe2\x88\x92"
                                 "0.5;\xc2\xa0"
                                 "1;0\n1;2\xe2\x80\xaf;1e\xe2\x88\x92"
                                 "1;0\n"));
  EXPECT_NEAR(degrees(series.samples[0].angles.x()), -0.5, 1e-12);
  EXPECT_NEAR(degrees(series.samples[1].angles.y()), 0.1, 1e-12);
  EXPECT_HAS(refusal_of([] {
               read_attitude_series(
                   write("time_s,roll_deg,pitch_deg,yaw_deg\n0,0,0,0\n1,\xe2\x80\x93"
                         "2,0,0\n"));
             }),
             "must be a finite number; it has U+2013, an en dash");
}

// Times with rounding errors are those of the series' ends.
TEST(TrajectoryOf, CoversTheRequestedTimesToTheirRounding) {
  const AttitudeSeries series =
      read_attitude_series(write("time_s,roll_deg,pitch_deg,yaw_deg\n0,0,0,0\n1,1,0,0\n2,2,0,0\n3,3,0,0\n"));
  for (const double start : {-2.9e-9, -1e-9, 0.0, 1e-9, 2.9e-9}) {
    const Trajectory trajectory = trajectory_of(series, start, 3, false, Vec3::Zero(), Vec3::Zero());
    EXPECT_NEAR(degrees(trajectory.sample(0).angles.x()), 0, 1e-8) << start;
    EXPECT_NEAR(degrees(trajectory.sample(3).angles.x()), 3, 1e-8) << start;
    EXPECT_THROW(trajectory.sample(-1e-6), std::out_of_range);
    EXPECT_THROW(trajectory.sample(3 + 1e-6), std::out_of_range);
  }
  EXPECT_NE(refusal_of([&] { trajectory_of(series, -4e-9, 3, false, Vec3::Zero(), Vec3::Zero()); }), "accepted");
}

TEST(SimulateAttitudeSeries, FollowsASeries) {
  std::string text = "time_s,roll_deg,pitch_deg,yaw_deg,surge_m,sway_m,heave_m\n";
  for (int n = 0; n <= 100; ++n)
    text += fmt::format("{},{},0,{},0,0,{}\n", n, 0.1 * n, n % 2 == 0 ? 179 : -179, 0.01 * n);
  MotionSpec spec;
  spec.model = MotionModel::kSeries;
  spec.file = write(text).string();
  spec.series_start_s = 20;
  spec.heading = MeanRule::kKeep;
  const Body body = make_body(spec, {});
  const Trajectory trajectory = simulate_motion(body, {1, 2, 3}, WaveField(), 30, 1, 0);
  EXPECT_NEAR(degrees(trajectory.sample(10).angles.x()), 3, 1e-9);
  EXPECT_EQ(trajectory.sample(10).translation.z(), 0);  // translations are off
  // A heading that varies about 180 deg does not make a full rotation from row to row.
  EXPECT_NEAR(degrees(trajectory.sample(10).angles.z()), 179, 1.5);
  EXPECT_NEAR(trajectory.pose(0).p.x(), 1, 1e-12);
  EXPECT_HAS(refusal_of([&] {
               simulate_motion(body, {0, 0, 0}, WaveField(), 90, 1, 0);
             }),
             "lasts from 0 to 100 s, 20 to 110 s are needed");
}

}  // namespace
}  // namespace seaglint

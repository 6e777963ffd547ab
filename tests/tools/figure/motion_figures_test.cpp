// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/motion_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/file.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

// A ship that moves with a wave's phase speed is at rest in the wave: all its snapshots equal the first.
TEST(MotionFrames, DrawTheWaterAtAShipsPosition) {
  const double omega = 30, wavenumber = omega * omega / kGravity;
  const WaveField sea({{omega, 0.1, 0.2, wavenumber}}, Vec2(1, 0), 1, 0);
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("motion_frames_" + std::to_string(::getpid()) + ".svg");
  const auto picture = [&](double speed, double period_s) {
    write_motion_frames({{"ship", Trajectory(), make_plate(2, 2), speed}}, sea, period_s, "title", file);
    std::string text = read_file(file);
    std::filesystem::remove(file);
    return text;
  };
  // A period this short is 0.0 s in the titles of its snapshots.
  const double period = 0.05;
  EXPECT_EQ(picture(omega / wavenumber, period), picture(0, 0));
  EXPECT_NE(picture(0, period), picture(0, 0));
}

// A heading of 300 deg that oscillates by 10 deg (7.07 deg rms) about it every 8 s: rms and period do not include the
// mean. The samples, 0.1 s apart, are those of ten whole periods, the last without its end.
TEST(MotionStatistics, AreThoseAboutTheMean) {
  constexpr double kStep = 0.1, kPeriod = 8, kDuration = 79.9;
  const double omega = 2 * kPi / kPeriod, swing = radians(10);
  std::vector<MotionSample> samples;
  for (int n = 0; n * kStep <= kDuration + 1e-9; ++n) {
    const double angle = omega * n * kStep;
    samples.push_back({{0, 0, radians(300) + swing * std::sin(angle)}, {0, 0, swing * omega * std::cos(angle)}});
  }
  const Trajectory trajectory(0, kStep, samples, Vec3::Zero(), Vec3::Zero());
  const std::string text = motion_statistics({{"float", trajectory, {}, 0}}, kDuration);
  EXPECT_THAT(text, testing::HasSubstr("yaw mean 300 deg, rms about it 7.07 deg, largest 310 deg, mean period 8 s"));
  EXPECT_THAT(text, testing::HasSubstr("roll mean 0 deg, rms about it 0 deg, largest 0 deg;"));
}

}  // namespace
}  // namespace seaglint

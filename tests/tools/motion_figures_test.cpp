// SPDX-License-Identifier: BSD-3-Clause
#include "tools/motion_figures.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "sim/core/constants.h"
#include "sim/core/file.h"
#include "sim/geometry/generators.h"

namespace seaglint {
namespace {

// A ship that goes with a wave's crests stays where the wave is still: all its moments are the first.
TEST(MotionFrames, DrawTheWaterThatAShipComesTo) {
  const double omega = 30, wavenumber = omega * omega / kGravity;
  const WaveField sea({{omega, 0.1, 0.2, wavenumber}}, Vec2(1, 0), 1, 0);
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("motion_frames_" + std::to_string(::getpid()) + ".svg");
  const auto picture = [&](double speed, double period_s) {
    write_motion_frames({{"ship", Trajectory(), make_plate(2, 2), speed}}, sea, period_s, "title", file);
    const std::string text = read_file(file);
    std::filesystem::remove(file);
    return text;
  };
  // A period this short is 0.0 s in the titles of its moments.
  const double period = 0.05;
  EXPECT_EQ(picture(omega / wavenumber, period), picture(0, 0));
  EXPECT_NE(picture(0, period), picture(0, 0));
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

// hh rises by 1 dB per view from 0 dBsm, vv lies 10 dB below it.
RcsSweep rising(std::size_t azimuths, std::vector<double> frequencies = {10e9}, std::vector<double> elevations = {2}) {
  RcsSweep sweep;
  sweep.frequency_hz = std::move(frequencies);
  sweep.elevation_deg = std::move(elevations);
  for (std::size_t i = 0; i < azimuths; ++i) sweep.azimuth_deg.push_back(static_cast<double>(i));
  RcsSweep::Model& model = sweep.models.emplace_back();
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    const double level = static_cast<double>(view % azimuths);
    model.matrices.emplace_back(sweep.frequency_hz.size(),
                                std::array<Complex, 4>{amplitude_of_dbsm(level), 0, 0, amplitude_of_dbsm(level - 10)});
  }
  return sweep;
}

TEST(LevelStatistics, AreThoseOfARampOfLevels) {
  const std::vector<LevelStatistics> statistics = level_statistics(rising(101));
  ASSERT_EQ(statistics.size(), 2u);
  const LevelStatistics &hh = statistics[0], &vv = statistics[1];
  EXPECT_NEAR(hh.lowest_tenth_dbsm, 10, 1e-9);
  EXPECT_NEAR(hh.median_dbsm, 50, 1e-9);
  EXPECT_NEAR(hh.highest_tenth_dbsm, 90, 1e-9);
  EXPECT_NEAR(hh.largest_dbsm, 100, 1e-9);
  EXPECT_EQ(hh.largest_azimuth_deg, 100);
  // The mean of the areas 10^(n/10), n = 0 ... 100: a geometric series.
  const double ratio = std::pow(10, 0.1);
  EXPECT_NEAR(hh.mean_dbsm, 10 * std::log10((std::pow(ratio, 101) - 1) / (ratio - 1) / 101), 1e-9);
  EXPECT_NEAR(vv.median_dbsm, 40, 1e-9);
  EXPECT_THAT(statistics_text(statistics), HasSubstr("50.0"));
  EXPECT_TRUE(level_statistics(rising(kFewestDrawn - 1)).empty());
}

TEST(LevelPlots, HaveTheLongestAxisAndAtMostFourPanels) {
  const PlotPanels one = level_plots(rising(101));
  ASSERT_EQ(one.plots.size(), 1u);
  EXPECT_EQ(one.plots[0].x.label, "azimuth (deg)");
  ASSERT_EQ(one.plots[0].series.size(), 4u);
  // The median in a window of ten steps of a ramp is the ramp.
  EXPECT_NEAR(one.plots[0].series[2].y[50], 50, 1e-9);
  EXPECT_EQ(level_plots(rising(20, {9e9, 10e9, 11e9}, {0, 1, 2})).plots.size(), 4u);
  EXPECT_EQ(level_plots(rising(2, std::vector<double>(8, 9e9))).plots[0].x.label, "frequency (GHz)");
  EXPECT_EQ(level_plots(rising(2, {9e9}, std::vector<double>(8, 1.0))).plots[0].x.label, "elevation (deg)");
  EXPECT_TRUE(level_plots(rising(2)).plots.empty());
}

// At the first of the levels 0, 1, 2, ... over a full turn half of the window's values are the last ones.
TEST(LevelPlots, HaveMediansThatGoOnOverAFullTurn) {
  EXPECT_NEAR(level_plots(rising(360)).plots[0].series[2].y[0], 5, 1e-9);
  EXPECT_NEAR(level_plots(rising(180)).plots[0].series[2].y[0], 2.5, 1e-9);
}

}  // namespace
}  // namespace seaglint

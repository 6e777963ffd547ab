// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/view_grids.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace seaglint {
namespace {

std::vector<ViewPoint> points_of(const std::vector<ViewGrid>& grids) {
  std::vector<ViewPoint> points;
  for (const ViewGrid& grid : grids) {
    for (const double f : grid.frequency_hz) {
      for (const double az : grid.azimuth_deg) {
        for (const double el : grid.elevation_deg) points.push_back({f, az, el});
      }
    }
  }
  std::sort(points.begin(), points.end());
  return points;
}

TEST(ViewGrids, OfASweepAreOne) {
  std::vector<ViewPoint> points;
  for (const double f : {2.0, 1.0, 3.0}) {
    for (const double az : {0.0, 10.0, 20.0}) {
      for (const double el : {5.0, 1.0}) points.push_back({f, az, el});
    }
  }
  const std::vector<ViewGrid> grids = view_grids(points);
  ASSERT_EQ(grids.size(), 1u);
  EXPECT_THAT(grids[0].frequency_hz, testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(grids[0].elevation_deg, testing::ElementsAre(1, 5));
}

// Three principal cuts, one of them at fewer frequencies, and a point that stands twice.
TEST(ViewGrids, HoldEveryPointOnce) {
  std::vector<ViewPoint> points;
  for (double angle = 0; angle < 90; angle += 30) {
    points.push_back({1, angle, 0});
    points.push_back({2, angle, 0});
    points.push_back({1, 0, angle});
    points.push_back({1, 90, angle});
  }
  const std::vector<ViewGrid> grids = view_grids(points);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  EXPECT_EQ(points_of(grids), points);
  EXPECT_LE(grids.size(), 4u);
  EXPECT_THAT(view_grids({}), testing::IsEmpty());
}

}  // namespace
}  // namespace seaglint

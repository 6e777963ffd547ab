// SPDX-License-Identifier: BSD-3-Clause
// Levels outside of the target on maps of known levels.
#include "classify/model/learning_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace seaglint {
namespace {

StoredAxes axes() {
  StoredAxes axes;
  for (int r = -96; r < 96; ++r) axes.range_m.push_back(r);
  for (int v = 0; v < 64; ++v) axes.velocity_mps.push_back(0.3 * (v - 32));
  return axes;
}

// Power of a cell by range and velocity; two centres, at -20 and 10 m.
template <class Power>
Sample map_of(Power power) {
  Sample sample;
  const StoredAxes grid = axes();
  for (const double v : grid.velocity_mps)
    for (const double r : grid.range_m) sample.magnitude.push_back(static_cast<float>(std::sqrt(power(r, v))));
  sample.centre_list = {{-20, 0.5f, 3}, {10, 0, 2}};
  return sample;
}

TEST(BlankedMap, OfUniformPowerIsLevel) {
  for (const double level : blanked_levels_db(map_of([](double, double) { return 7.0; }), axes()))
    EXPECT_NEAR(level, 0, 1e-6);
}

// Any power within 6 m of the centres and between them, and any common factor outside.
TEST(BlankedMap, DoesNotDependOnTheTargetNorOnTheLevelOfTheRest) {
  const auto rest = [](double r, double v) { return 1 + 0.5 * std::sin(0.1 * r) * std::cos(v); };
  const auto plain = map_of(rest);
  const auto loud = map_of([&](double r, double v) { return r >= -26 && r <= 16 ? 1e6 * v * v : 100 * rest(r, v); });
  const std::vector<double> a = blanked_levels_db(plain, axes()), b = blanked_levels_db(loud, axes());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << i;
}

// Ten times the power in the band of 10 to 25 m at the lowest eighth of velocities: 26 < r' < 41 m on both sides.
TEST(BlankedMap, HasTheLevelOfItsBands) {
  const auto sample = map_of([](double r, double v) {
    const double outside = std::max(-26 - r, r - 16);
    return outside >= 10 && outside < 25 && v < 0.3 * (8 - 32) - 0.01 ? 10.0 : 1.0;
  });
  const std::vector<double> levels = blanked_levels_db(sample, axes());
  ASSERT_EQ(levels.size(), 32u);
  EXPECT_EQ(std::ranges::max_element(levels) - levels.begin(), 8);
  for (std::size_t i = 0; i < levels.size(); ++i) EXPECT_NEAR(levels[8] - levels[i], i == 8 ? 0 : 10, 1e-4) << i;
}

TEST(BlankedMap, WithoutRangesOutsideIsZero) {
  Sample sample = map_of([](double, double) { return 1.0; });
  sample.centre_list = {{-95, 0, 1}, {95, 0, 1}};
  for (const double level : blanked_levels_db(sample, axes())) EXPECT_EQ(level, 0);
  const Sample dark = map_of([](double, double) { return 0.0; });
  for (const double level : blanked_levels_db(dark, axes())) EXPECT_EQ(level, 0);
}

}  // namespace
}  // namespace seaglint

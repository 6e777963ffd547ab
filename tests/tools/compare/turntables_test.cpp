// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/turntables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/geometry/look_basis.h"
#include "tests/tools/compare/grid.h"

namespace seaglint {
namespace {

// Cuts over frequency at every azimuth, of a point at `reference` in the export and at `compared` in the other values.
std::vector<PairedCut> cuts_of_points(const std::vector<double>& azimuth_deg, const Vec3& reference,
                                      const Vec3& compared) {
  std::vector<PairedCut> cuts;
  for (const double azimuth : azimuth_deg) {
    PairedCut& cut = cuts.emplace_back();
    cut.reference = "export.csv";
    cut.element = Polarisation::kVv;
    cut.axis = CutAxis::kFrequency;
    cut.models.push_back({"seaglint", {}, {}});
    for (const double f : grid(9.7e9, 6e6, 101)) {
      PairedCut::Place place;
      place.frequency_hz = f;
      place.azimuth_deg = azimuth;
      place.path_gradient = 4 * kPi * f / kSpeedOfLight * direction_to_radar(radians(azimuth), 0);
      const auto amplitude = [&](const Vec3& x) {
        return std::polar(amplitude_of_dbsm(3), place.path_gradient.dot(x));
      };
      cut.places.push_back(place);
      cut.x.push_back(1e-9 * f);
      cut.amplitude_m.push_back(amplitude(reference));
      cut.models[0].amplitude_m.push_back(amplitude(compared));
      cut.level_dbsm.push_back(3);
      cut.models[0].level_dbsm.push_back(3);
    }
  }
  return cuts;
}

TEST(ComparedTurntable, HasBothPointsInPicturesOfEqualAxes) {
  const auto turntable = compared_turntable(cuts_of_points(grid(-2, 0.04, 101), {4, 1, 0}, {4, -2, 0}));
  ASSERT_TRUE(turntable);
  EXPECT_EQ(turntable->reference.element, 3u);
  const std::vector<Heatmap> pictures = turntable_pictures(*turntable, {.threads = 1});
  ASSERT_EQ(pictures.size(), 4u);
  EXPECT_EQ(pictures[0].title, "export.csv: vv");
  EXPECT_EQ(pictures[2].title, "seaglint: vv");
  EXPECT_EQ(pictures[0].colour.range, pictures[2].colour.range);
  EXPECT_EQ(pictures[0].map.x, pictures[2].map.x);
  EXPECT_EQ(pictures[1].profile->colour, kReferenceColour);
  EXPECT_EQ(pictures[3].profile->colour, kComputedColour);
  const auto peak = [](const Heatmap& image) {
    const auto at = static_cast<std::size_t>(std::ranges::max_element(image.map.values) - image.map.values.begin());
    return std::array{image.map.x[at % image.map.x.size()], image.map.y[at / image.map.x.size()], image.map.values[at]};
  };
  // The radar is ahead: range -x, and port is to the right, cross range -y.
  constexpr double kCell = 0.06;
  const auto of_export = peak(pictures[0]), of_compared = peak(pictures[2]);
  EXPECT_NEAR(of_export[0], -4, kCell);
  EXPECT_NEAR(of_export[1], -1, kCell);
  EXPECT_NEAR(of_export[2], 3, 0.5);
  EXPECT_NEAR(of_compared[0], -4, kCell);
  EXPECT_NEAR(of_compared[1], 2, kCell);
}

TEST(ComparedTurntable, IsAbsentOfUnevenOrFewAnglesAndWithoutPhases) {
  std::vector<double> uneven = grid(-2, 0.04, 101);
  uneven[50] += 0.01;
  EXPECT_FALSE(compared_turntable(cuts_of_points(uneven, {4, 1, 0}, {4, 1, 0})));
  EXPECT_FALSE(compared_turntable(cuts_of_points(grid(0, 1, 7), {4, 1, 0}, {4, 1, 0})));
  std::vector<PairedCut> levels = cuts_of_points(grid(0, 1, 9), {4, 1, 0}, {4, 1, 0});
  EXPECT_TRUE(compared_turntable(levels));
  for (PairedCut& cut : levels) cut.amplitude_m.clear();
  EXPECT_FALSE(compared_turntable(levels));
  std::vector<PairedCut> bistatic = cuts_of_points(grid(0, 1, 9), {4, 1, 0}, {4, 1, 0});
  for (PairedCut& cut : bistatic) {
    for (PairedCut::Place& place : cut.places) place.path_gradient *= 0.9;
  }
  EXPECT_FALSE(compared_turntable(bistatic));
}

}  // namespace
}  // namespace seaglint

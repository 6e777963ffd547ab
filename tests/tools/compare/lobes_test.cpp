// SPDX-License-Identifier: BSD-3-Clause
// Lobes, nulls and range profiles against closed forms.
#include "tools/compare/curve_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// Levels of a uniform aperture, sinc(u), of which the lobes and nulls are known.
struct Pattern {
  std::vector<double> u, level_db;
};

Pattern aperture(double shift) {
  Pattern pattern;
  for (int i = -200; i <= 200; ++i) {
    const double u = 0.02 * i, v = kPi * (u - shift);
    pattern.u.push_back(u);
    pattern.level_db.push_back(20 * std::log10(std::max(std::abs(std::abs(v) < 1e-9 ? 1.0 : std::sin(v) / v), 1e-4)));
  }
  return pattern;
}

TEST(Lobes, OfAnApertureAreWhereTheyMustBe) {
  const Pattern p = aperture(0);
  const std::vector<Extremum> lobes = lobes_of(p.u, p.level_db, -60);
  ASSERT_EQ(lobes.size(), 7u);  // one and three on either side, at tan(pi u) = pi u
  EXPECT_NEAR(lobes[3].x, 0, 1e-6);
  EXPECT_NEAR(lobes[4].x, 1.4303, 1e-3);
  EXPECT_NEAR(lobes[4].level_db, -13.261, 0.01);
  EXPECT_NEAR(lobes[5].x, 2.4590, 1e-3);
  const std::vector<Extremum> nulls = nulls_of(p.u, p.level_db, -100);
  ASSERT_EQ(nulls.size(), 6u);
  EXPECT_NEAR(nulls[3].x, 1, 1e-3);
  EXPECT_THAT(lobes_of(p.u, p.level_db, -15), testing::SizeIs(3));
}

TEST(Lobes, ArePairedWithTheNearest) {
  const Pattern a = aperture(0), b = aperture(0.06);
  const ExtremumPairs pairs = paired_extrema(lobes_of(a.u, a.level_db, -30), lobes_of(b.u, b.level_db, -30));
  EXPECT_EQ(pairs.count, 7u);
  EXPECT_EQ(pairs.paired, 7u);
  EXPECT_NEAR(pairs.mean_shift, 0.06, 1e-3);
  EXPECT_NEAR(pairs.mean_db, 0, 0.01);
  EXPECT_EQ(paired_extrema(lobes_of(a.u, a.level_db, -30), {}).paired, 0u);
}

TEST(RangeProfile, OfAPointHasItsPlaceAndLevel) {
  std::vector<PairedCut::Place> places;
  std::vector<Complex> amplitudes;
  for (int i = 0; i < 101; ++i) {
    PairedCut::Place place;
    place.frequency_hz = 9e9 + 1e7 * i;
    place.path_gradient = Vec3(4 * kPi * place.frequency_hz / kSpeedOfLight, 0, 0);
    places.push_back(place);
    amplitudes.push_back(0.5 * std::polar(1.0, place.path_gradient.dot(Vec3(-1.25, 2, 0))));
  }
  const RangeProfile profile = range_profile(places, amplitudes);
  ASSERT_FALSE(profile.range_m.empty());
  const auto peak = std::max_element(profile.level_dbsm.begin(), profile.level_dbsm.end()) - profile.level_dbsm.begin();
  const double cell = profile.range_m[1] - profile.range_m[0];
  EXPECT_NEAR(profile.range_m[static_cast<std::size_t>(peak)], 1.25, cell);  // behind the origin
  EXPECT_NEAR(profile.level_dbsm[static_cast<std::size_t>(peak)], 10 * std::log10(4 * kPi * 0.25),
              0.3);  // of a quarter cell
  EXPECT_NEAR(profile.range_m.back() - profile.range_m.front(), kSpeedOfLight / 2e7, 1e-6);
  places[40].path_gradient *= 1.001;
  EXPECT_THAT(range_profile(places, amplitudes).range_m, testing::IsEmpty()) << "uneven steps";
}

}  // namespace
}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
// Weights of complementary forms sum to one, for the directions as each form computes its own.
#include "sim/scattering/coefficients/fade_windows.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

constexpr double kRounding = 1e-12;

Vec3 reflected(const Vec3& x, const Vec3& n) { return x - 2 * n.dot(x) * n; }

// A wall 1 m high on a deck of 6 x 6 m.
struct WallOnDeck {
  std::vector<Vec3> deck{{3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, {-3, -3, 0}}, wall;
  Vec3 wall_normal;

  explicit WallOnDeck(double lean) : wall_normal(std::cos(lean), 0, std::sin(lean)) {
    const Vec3 up(-std::sin(lean), 0, std::cos(lean));
    wall = {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0, 1, 0) + up, Vec3(0, -1, 0) + up};
  }
  ReflectorPanel deck_panel() const { return {Vec3::UnitZ(), deck}; }
  ReflectorPanel wall_panel() const { return {wall_normal, wall}; }
};

Vec3 random_direction(Random& random, double highest_sine) {
  const double sine = highest_sine * random.uniform(), azimuth = 2 * kPi * random.uniform();
  const double cosine = std::sqrt(1 - sine * sine);
  return {cosine * std::cos(azimuth), cosine * std::sin(azimuth), sine};
}

TEST(PathWeights, PathAndReciprocalSumToTwo) {
  Random random({1, Stream::kTest, 0});
  int replaced = 0;
  for (int i = 0; i < 2000; ++i) {
    const WallOnDeck body(0.3 * (random.uniform() - 0.5));
    const Vec3 r = random_direction(random, 0.2);
    const double by_deck = double_bounce_weight(r, body.wall_panel(), body.deck_panel()),
                 by_wall = double_bounce_weight(r, body.deck_panel(), body.wall_panel());
    EXPECT_NEAR(by_deck + by_wall, 2, kRounding);
    EXPECT_GE(std::min(by_deck, by_wall), 0);
    replaced += by_deck < 0.5;
  }
  EXPECT_GT(replaced, 100);
}

TEST(PathWeights, PathAndImageSumToOne) {
  Random random({2, Stream::kTest, 0});
  int images = 0;
  for (int i = 0; i < 2000; ++i) {
    const WallOnDeck body(0.3 * (random.uniform() - 0.5));
    const Vec3 r = random_direction(random, 0.2);
    const double image = image_weight(r, body.deck_panel(), body.wall_panel());
    EXPECT_NEAR(multiple_bounce_weight(r, body.deck_panel(), body.wall_panel(), body.deck_panel()) + image, 1,
                kRounding);
    images += image > 0.5;
  }
  EXPECT_GT(images, 100);
}

// Edge of a deck along y with an upright wall behind it: incident from r, via the wall back to r.
TEST(PathWeights, EdgeFieldAndPenumbraSumToOne) {
  int both = 0;
  for (double sine = 0.001; sine < 0.99; sine += 0.001) {
    const Vec3 r(std::sqrt(1 - sine * sine), 0, sine), wall = Vec3::UnitX(), via_wall = reflected(r, wall);
    const double edge = reflected_edge_weight(Vec3::UnitZ(), Vec3::UnitY(), -r, via_wall, wall);
    const PenumbraWeights penumbra = penumbra_weights(sine);
    EXPECT_NEAR(edge + penumbra.foot, 1, kRounding) << sine;
    EXPECT_NEAR(grazing_wave_weight(-r, via_wall) + penumbra.edge_path, 1, kRounding) << sine;
    both += edge > 0.01 && edge < 0.99;
  }
  EXPECT_GT(both, 10);
}

}  // namespace
}  // namespace seaglint

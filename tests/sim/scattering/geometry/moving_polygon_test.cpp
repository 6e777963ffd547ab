// SPDX-License-Identifier: BSD-3-Clause
// Moving polygons against finite differences, and the phase integral against quadrature.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/tracing/visible_surface.h"

namespace seaglint {
namespace {

MovingPolygon square(double x, double y, double side) {
  MovingPolygon polygon(4);
  polygon[0].p = {x, y};
  polygon[1].p = {x + side, y};
  polygon[2].p = {x + side, y + side};
  polygon[3].p = {x, y + side};
  return polygon;
}

// The polygon for a change d1 of the look direction, to first order.
MovingPolygon moved(MovingPolygon polygon, double d1) {
  for (MovingVertex& c : polygon) c.p += d1 * c.d1;
  return polygon;
}

MovingPolygon counter_clockwise(MovingPolygon polygon) {
  if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

TEST(PolygonSet, SubtractingAHoleKeepsTheAreaOutsideIt) {
  Random random({3, Stream::kTest, 0});
  for (int trial = 0; trial < 300; ++trial) {
    PolygonSet pieces;
    pieces.assign(std::array{square(random.uniform(), random.uniform(), 0.2 + random.uniform())});
    for (int holes = 0; holes < 3; ++holes) {  // the later ones intersect several polygons
      MovingPolygon hole(3);
      for (MovingVertex& c : hole) c.p = {2 * random.uniform(), 2 * random.uniform()};
      hole = counter_clockwise(hole);
      double left = pieces.area();
      for (const MovingPolygon& piece : pieces.polygons()) {
        const MovingPolygon common = intersect(piece, hole);
        left -= common.empty() ? 0 : signed_area(common);
      }
      pieces.subtract_hole(hole, box_of(hole), 0);
      EXPECT_NEAR(pieces.area(), left, 1e-9);  // slivers within 1e-10 of a line count as on it
    }
    ASSERT_EQ(pieces.boxes().size(), pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const MovingPolygon& piece = pieces.polygons()[i];
      EXPECT_GE(signed_area(piece), 0);
      EXPECT_EQ(pieces.boxes()[i].lower, box_of(piece).lower);
      EXPECT_EQ(pieces.boxes()[i].upper, box_of(piece).upper);
    }
  }
}

TEST(MovingPolygon, ClippedVerticesMoveAsTheIntersectionOfTheirLines) {
  MovingPolygon window = square(0, 0, 1);  // at rest
  MovingPolygon moving(3);
  moving[0] = {{-0.3, 0.4}, {0.2, 0.1}, {0, 0}};
  moving[1] = {{0.7, -0.2}, {-0.1, 0.3}, {0, 0}};
  moving[2] = {{1.4, 1.3}, {0.05, -0.2}, {0, 0}};
  moving = counter_clockwise(moving);
  const MovingPolygon common = intersect(window, moving);
  ASSERT_GE(common.size(), 4u);
  constexpr double kStep = 1e-6;
  const MovingPolygon after = intersect(window, moved(moving, kStep)),
                      before = intersect(window, moved(moving, -kStep));
  ASSERT_EQ(after.size(), common.size());
  for (std::size_t i = 0; i < common.size(); ++i) {
    const Vec2 difference = (after[i].p - before[i].p) / (2 * kStep);
    EXPECT_NEAR((difference - common[i].d1).norm(), 0, 1e-6) << i;  // central differences: kStep^2 and rounding / kStep
  }
}

// A bounding box that is infinite leaves every side to the vertices: the result with the exact box is identical.
// Vertices on a lattice lie on each other's sides, and some sides have no length.
TEST(MovingPolygon, BoundingBoxesDoNotChangeClipping) {
  constexpr double kFar = 1e6;
  const Box everywhere{{-kFar, -kFar}, {kFar, kFar}};
  Random random({3, Stream::kTest, 2});
  std::size_t common_parts = 0, cuts = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const auto corner = [&]() -> Vec2 {
      const Vec2 p(random.uniform(), random.uniform());
      return trial % 2 == 0 ? p : Vec2(std::round(4 * p.x()), std::round(4 * p.y()));
    };
    const auto triangle = [&] {
      MovingPolygon polygon(3);
      for (MovingVertex& c : polygon) c = {corner(), corner(), corner()};
      polygon = counter_clockwise(polygon);
      if (trial % 3 == 0) polygon.push_back(polygon.back());  // a side without length
      return polygon;
    };
    const MovingPolygon a = triangle(), b = triangle();
    const auto same = [](const MovingPolygon& one, const MovingPolygon& other) {
      return std::ranges::equal(one, other, [](const MovingVertex& p, const MovingVertex& q) {
        return p.p == q.p && p.d1 == q.d1 && p.d2 == q.d2;
      });
    };
    const MovingPolygon common = intersect(a, b);
    EXPECT_TRUE(same(common, intersect(a, everywhere, b))) << trial;
    std::vector<MovingPolygon> left, left_by_corners;
    const bool cut = subtract(a, box_of(a), b, 1e-6, left);
    EXPECT_EQ(cut, subtract(a, everywhere, b, 1e-6, left_by_corners)) << trial;
    EXPECT_TRUE(std::ranges::equal(left, left_by_corners, same)) << trial;
    common_parts += !common.empty();
    cuts += cut;
  }
  EXPECT_GT(common_parts, 1000u);
  EXPECT_GT(cuts, 500u);
}

TEST(MovingPolygon, HalvesEqualClippingOnEitherSide) {
  Random random({3, Stream::kTest, 1});
  const MovingPolygon whole = square(0, 0, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const double angle = 2 * kPi * random.uniform();
    MovingLine line;
    line.gradient = {std::cos(angle), std::sin(angle)};
    line.value = 3 * random.uniform() - 1.5;  // some do not intersect the square
    if (trial < 8) {                          // along a side, through vertices, and along the diagonal
      line.gradient = std::array<Vec2, 4>{Vec2(1, 0), Vec2(0, -1), Vec2(1, 1), Vec2(1, -1)}[trial % 4];
      line.value = trial < 4 ? 0 : -1;
    }
    const std::array<MovingPolygon, 2> half = split_by_line(whole, line);
    double area = 0;
    for (int i = 0; i < 2; ++i) {
      const MovingPolygon alone = clip(whole, line, i == 0 ? +1 : -1);
      ASSERT_EQ(half[i].size(), alone.size()) << trial;
      for (std::size_t c = 0; c < alone.size(); ++c) {
        EXPECT_EQ(half[i][c].p, alone[c].p);
        EXPECT_EQ(half[i][c].d1, alone[c].d1);
        EXPECT_GE((i == 0 ? 1 : -1) * line.at(half[i][c].p), -1e-15);  // rounding
      }
      area += half[i].empty() ? 0 : signed_area(half[i]);
    }
    EXPECT_NEAR(area, 1, 1e-14);  // as above, rounding of some numbers of order one
  }
  MovingLine on_it;  // a polygon without area along the line belongs to neither side
  on_it.gradient = {0, 1};
  MovingPolygon flat(3);
  flat[1].p = {1, 0};
  flat[2].p = {2, 0};
  for (const MovingPolygon& half : split_by_line(flat, on_it)) EXPECT_TRUE(half.empty());
}

TEST(MovingPolygon, TheIntersectionOfTwoPlanesMovesWithTheDirection) {
  // Planes n1.x = c1, n2.x = c2 seen from r and from r rotated by d1 h: the heights' difference vanishes on the same
  // body points.
  const Vec3 n1 = Vec3(1, 0.3, -0.2).normalized(), n2 = Vec3(0.7, -0.4, 0.5).normalized();
  const auto line_at = [&](double d1) {
    RadarBasis basis;
    basis.r = (Vec3::UnitX() + d1 * Vec3::UnitY()).normalized();
    basis.h = (Vec3::UnitY() - d1 * Vec3::UnitX()).normalized();
    return depth_difference(depth_plane(n1, 0.3, basis), depth_plane(n2, 0.5, basis));
  };
  const MovingLine line = line_at(0);
  constexpr double kStep = 1e-5;
  for (const Vec2& p : {Vec2(0.2, -0.4), Vec2(-1.1, 0.6)}) {
    const double numeric = (line_at(kStep).at(p) - line_at(-kStep).at(p)) / (2 * kStep);
    EXPECT_NEAR(line.value_d1 + line.gradient_d1.dot(p), numeric, 1e-8);
  }
}

TEST(PhaseIntegral, EqualsQuadratureFromFlatPhaseToManyCycles) {
  Footprint footprint;
  footprint.polygon.resize(4);
  footprint.polygon[0].p = {0.1, 0.2};
  footprint.polygon[1].p = {1.3, 0.1};
  footprint.polygon[2].p = {1.6, 0.9};
  footprint.polygon[3].p = {0.7, 1.4};
  footprint.psi0 = 0.37;
  for (const double slope : {0.0, 1e-4, 0.03, 0.08, 0.12, 0.5, 3.0, 40.0}) {
    footprint.w = slope * Vec2(0.6, -0.8);
    const double k = 1.7;
    // Midpoint rule on triangles (0, 1, 2) and (0, 2, 3), mapped from the unit square: converges as 1/n^2.
    const auto quadrature = [&](int n) {
      Complex sum = 0;
      for (const int last : {2, 3}) {
        const Vec2 a = footprint.polygon[0].p, b = footprint.polygon[last - 1].p, c = footprint.polygon[last].p;
        const double twice = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
        for (int i = 0; i < n; ++i) {
          for (int j = 0; j < n; ++j) {
            const double u = (i + 0.5) / n, v = (j + 0.5) / n;
            const Vec2 p = a + u * ((b - a) + v * (c - b));
            sum += twice * u / (n * n) * std::polar(1.0, k * footprint.psi(p));
          }
        }
      }
      return sum;
    };
    const Complex coarse = quadrature(400), fine = quadrature(800), richardson = fine + (fine - coarse) / 3.0;
    EXPECT_LT(std::abs(flat_phase_integral(footprint, footprint.polygon, k) - richardson), 2e-6) << slope;
  }
}

}  // namespace
}  // namespace seaglint

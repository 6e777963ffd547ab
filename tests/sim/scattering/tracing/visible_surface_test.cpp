// SPDX-License-Identifier: BSD-3-Clause
// The visible surface against areas in closed form, and against rays.
#include "sim/scattering/tracing/visible_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/tracing/beam_scene.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr double kRounding = 1e-12;  // of areas of about 1 m^2 after a few clips

double visible_area(const BeamScene& scene, int facet) { return area_of(scene.aspect.visible.pieces(facet)); }

// Area of everything that the antenna sees.
double visible_area(const BeamScene& scene) {
  double area = 0;
  for (const int facet : scene.seen()) area += visible_area(scene, facet);
  return area;
}

// Panel of the part with this number, which is one panel.
int only_panel(const Scatterer& scatterer, int part) {
  const auto facet = std::ranges::find(scatterer.facets(), part, &Facet::part);
  return scatterer.panels().representative(static_cast<int>(facet - scatterer.facets().begin()));
}

double overlap_of_intervals(double centre_a, double width_a, double centre_b, double width_b) {
  return std::max(0.0, std::min(centre_a + width_a / 2, centre_b + width_b / 2) -
                           std::max(centre_a - width_a / 2, centre_b - width_b / 2));
}

TEST(VisibleSurface, OfAPlateBehindAnotherIsItsAreaLessTheirOverlap) {
  Random random({41, Stream::kTest, 0});
  int partly = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double length = 0.3 + random.uniform(), width = 0.3 + random.uniform();       // of the plate in front
    const double x = 0.1 + random.uniform(), y = random.normal(), z = random.normal();  // its place
    const Vec3 r = Vec3(1, random.uniform() - 0.5, random.uniform() - 0.5).normalized();
    TriangleMesh mesh = make_plate(1, 0.8);
    TriangleMesh front = transformed(make_plate(length, width), Mat3::Identity(), {x, 0.3 * y, 0.3 * z});
    front.part_names = {"front"};
    mesh.append(front);
    const Scatterer plates(mesh);
    const BeamScene scene(plates, r, 1);
    // The front plate along the ray on the plane of the other.
    const double hidden = overlap_of_intervals(0, 1, 0.3 * y - x * r.y() / r.x(), length) *
                          overlap_of_intervals(0, 0.8, 0.3 * z - x * r.z() / r.x(), width);
    partly += hidden > 0.05 && hidden < 0.75;
    const double left_out = 4 * scene.smallest.on(0);  // a hole leaves four pieces at most
    EXPECT_NEAR(visible_area(scene, only_panel(plates, 0)), r.x() * (0.8 - hidden), kRounding + left_out) << trial;
    EXPECT_NEAR(visible_area(scene, only_panel(plates, 1)), r.x() * length * width, kRounding) << trial;
  }
  EXPECT_GT(partly, 50);
}

TEST(VisibleSurface, OfAConvexBodyFillsTheHullOfItsProjectedVertices) {
  Random random({41, Stream::kTest, 1});
  const TriangleMesh ball = make_sphere(0.5, 2);
  for (const TriangleMesh& mesh : {random_boxes(random, 1, 0), make_cylinder(0.3, 0.8, 17), ball}) {
    const Scatterer body(mesh, {}, 0.0);
    for (int trial = 0; trial < 20; ++trial) {
      const BeamScene scene(body, random_direction(random), 1);
      std::vector<Vec2> vertices;
      for (const Vec3& x : mesh.vertices) vertices.push_back(scene.projected(x - body.centre()));
      // Panels that are nearly edge-on, and pieces of panels next to the outline, may be left out.
      const double left_out = 2 * static_cast<double>(scene.seen().size()) * scene.smallest.on(0);
      EXPECT_NEAR(visible_area(scene), signed_area(convex_hull(vertices)), kRounding + left_out) << trial;
    }
  }
}

// Every ray meets one piece, that of the panel that Embree finds first, or none.
TEST(VisibleSurface, OfRandomBodiesHasOnePieceAtEveryRayThatHits) {
  constexpr int kRays = 4000;
  constexpr double kBorder = 1e-5;  // Embree's single precision, 6e-8 of a metre, at a panel inclined by 1 / 100
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random({42, Stream::kTest, seed});
    const Scatterer body(random_boxes(random, 6, 4));
    const BeamScene scene(body, random_direction(random), 1);
    std::vector<std::pair<int, MovingPolygon>> pieces;
    for (const int facet : scene.seen()) {
      for (const MovingPolygon& piece : scene.aspect.visible.pieces(facet)) pieces.emplace_back(facet, piece);
    }
    int hits = 0, at_border = 0;
    for (int n = 0; n < kRays; ++n) {
      const Vec2 p = body.radius() * Vec2(2 * random.uniform() - 1, 2 * random.uniform() - 1);
      const Ray ray{p.x() * scene.basis.h + p.y() * scene.basis.v + 2 * body.radius() * scene.basis.r, -scene.basis.r};
      int hit = kNoFacet;
      body.ray_scene().first_hits({&ray, 1}, {&hit, 1});
      std::vector<int> met;
      bool near_border = false;
      for (const auto& [facet, piece] : pieces) {
        const double depth = depth_inside(piece, p);
        near_border |= std::abs(depth) < kBorder;
        if (depth > 0) met.push_back(facet);
      }
      if (near_border) {
        ++at_border;
        continue;
      }
      hits += hit != kNoFacet;
      const std::vector<int> expected =
          hit == kNoFacet ? std::vector<int>{} : std::vector<int>{body.panels().representative(hit)};
      EXPECT_EQ(met, expected) << "body " << seed << ", ray " << n;
    }
    EXPECT_GT(hits, kRays / 10);
    EXPECT_LT(at_border, kRays / 100);
  }
}

TEST(VisibleSurface, HasPiecesWithoutCommonAreaThatLieWithinTheirPanels) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random({43, Stream::kTest, seed});
    const Scatterer body(random_boxes(random, 6, 4));
    const BeamScene scene(body, random_direction(random), 1);
    std::vector<MovingPolygon> pieces;
    for (const int facet : scene.seen()) {
      std::vector<Vec2> corners;
      for (const Vec3& x : body.panels().outline(facet)) corners.push_back(scene.projected(x));
      const MovingPolygon panel = convex_hull(corners);
      for (const MovingPolygon& piece : scene.aspect.visible.pieces(facet)) {
        for (const MovingVertex& vertex : piece) EXPECT_GT(depth_inside(panel, vertex.p), -kLineTolerance - kRounding);
        pieces.push_back(piece);
      }
    }
    double common = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const MovingPolygon both = intersect(pieces[i], pieces[j]);
        if (!both.empty()) common += signed_area(both);
      }
    }
    // Holes of less than the smallest area stay.
    const double uncut = static_cast<double>(pieces.size()) * scene.smallest.on(0);
    EXPECT_LE(common, kRounding + uncut) << seed;
    EXPECT_GT(pieces.size(), 20u);
  }
}

}  // namespace
}  // namespace seaglint

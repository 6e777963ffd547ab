// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/ray_paths.h"
#include "sim/scattering/tracing/transmitted_wave.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Scene of one antenna for rays.
struct Scene {
  Scatterer target;
  RadarBasis basis;
  TracingSettings settings{0, 8, false, {}, SolverMethod::kRays};
  Aspect aspect{target, basis, settings, 1};
  std::vector<Receiver> receivers{{monostatic(basis), aspect.visible}};
  TracingContext context{target, basis, receivers, settings, aspect.visible, {}, SmallestAreas(target, settings)};

  Scene(const TriangleMesh& mesh, const Vec3& r_hat) : target(mesh), basis(radar_basis(r_hat)) {}
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
};

// Random points of the projection plane within `radius` of the origin of the target.
std::vector<Vec2> points(const Scene& scene, int count, double radius) {
  Random random({1, Stream::kTest, 0});
  const Vec3 origin = -scene.target.centre();
  const Vec2 middle(origin.dot(scene.basis.h), origin.dot(scene.basis.v));
  std::vector<Vec2> p;
  for (int i = 0; i < count; ++i)
    p.push_back(middle + radius * Vec2(2 * random.uniform() - 1, 2 * random.uniform() - 1));
  return p;
}

// The sequences that random rays meet.
struct TracedScene : Scene {
  RayPaths paths{context};
  std::vector<Vec2> rays;
  std::vector<std::uint64_t> signatures;

  TracedScene(const TriangleMesh& mesh, const Vec3& r_hat, double radius)
      : Scene(mesh, r_hat), rays(points(*this, 3000, radius)), signatures(rays.size()) {
    paths.start();
    paths.trace(rays, signatures);
  }
};

TEST(RayPaths, ATrihedralReturnsEveryRayOfThreeBouncesAntiparallelFromTheMirroredPoint) {
  const TracedScene scene(make_square_trihedral(1), direction(40, 30), 0.4);
  const RayPaths& paths = scene.paths;
  int triple = 0;
  for (int first = paths.path(0).first_child; first >= 0; first = paths.path(first).next_sibling) {
    for (int second = paths.path(first).first_child; second >= 0; second = paths.path(second).next_sibling) {
      for (int third = paths.path(second).first_child; third >= 0; third = paths.path(third).next_sibling) {
        ++triple;
        EXPECT_LT((paths.path(third).direction - scene.basis.r).norm(), 1e-12);
        // Three mirrors at right angles are an inversion in their corner, the origin of the mesh.
        EXPECT_LT((paths.path(third).image_transform.L + Mat3::Identity()).norm(), 1e-12);
        EXPECT_LT((paths.path(third).image_transform.t + 2 * scene.target.centre()).norm(), 1e-12);
      }
    }
  }
  EXPECT_EQ(triple, 6);  // orders of the three faces
}

TEST(RayPaths, ASignatureDependsNeitherOnTheBatchNorOnTheOrderOfItsRays) {
  TracedScene scene(stepped_corner(), direction(35, 25), 0.3);
  std::vector<std::uint64_t> again(scene.rays.size());
  const std::vector<Vec2> reversed(scene.rays.rbegin(), scene.rays.rend());
  scene.paths.trace(reversed, again);
  std::reverse(again.begin(), again.end());
  EXPECT_EQ(scene.signatures, again);
  const std::set<std::uint64_t> distinct(again.begin(), again.end());
  EXPECT_GT(distinct.size(), 8u);
  EXPECT_LT(distinct.size(), 60u);
}

TEST(RayPaths, ThePlateBeforeACornerIsAnObstacleOfTheWallsThatItHides) {
  const TriangleMesh mesh = stepped_corner();
  TracedScene scene(mesh, direction(35, 25), 0.3);
  scene.paths.finish();
  const RayPaths& paths = scene.paths;
  const auto plate = static_cast<std::uint16_t>(mesh.part_names.size() - 1);  // the last part
  int hidden = 0;
  for (int first = paths.path(0).first_child; first >= 0; first = paths.path(first).next_sibling) {
    EXPECT_TRUE(paths.obstacles(first, 0).empty());  // the receiver sees what it illuminates
    for (int second = paths.path(first).first_child; second >= 0; second = paths.path(second).next_sibling) {
      for (const Obstacle& obstacle : paths.obstacles(second, 0))
        hidden += scene.target.facets()[obstacle.facet].part == plate;
    }
  }
  EXPECT_GT(hidden, 0);
}

}  // namespace
}  // namespace seaglint

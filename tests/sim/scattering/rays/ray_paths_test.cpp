// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/rays/ray_paths.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Scene of one antenna for rays.
struct Scene {
  Scatterer target;
  RadarBasis basis;
  TracingSettings settings{0, 8, false, {}, SolverMethod::kRays};
  std::vector<Receiver> receivers{{monostatic(basis), nullptr}};
  TracingContext context{target, basis, receivers, settings, nullptr, {}, SmallestAreas(target, settings)};

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

TEST(RayPaths, ATrihedralReturnsEveryRayOfThreeBouncesAntiparallelFromTheMirroredPoint) {
  Scene scene(make_square_trihedral(1), direction(40, 30));
  RayPaths paths(scene.context);
  const std::vector<Vec2> rays = points(scene, 2000, 0.4);
  std::vector<std::uint64_t> signatures(rays.size());
  paths.start();
  paths.trace(rays, signatures);
  paths.finish();
  int triple = 0;
  for (int first = paths.path(0).first_child; first >= 0; first = paths.path(first).next_sibling) {
    for (int second = paths.path(first).first_child; second >= 0; second = paths.path(second).next_sibling) {
      for (int third = paths.path(second).first_child; third >= 0; third = paths.path(third).next_sibling) {
        if (!paths.path(first).met || !paths.path(second).met || !paths.path(third).met) continue;
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

TEST(RayPaths, RaysOfEqualSignatureMeetTheSamePanels) {
  Scene scene(stepped_corner(), direction(35, 25));
  RayPaths paths(scene.context);
  const std::vector<Vec2> rays = points(scene, 3000, 0.3);
  std::vector<std::uint64_t> signatures(rays.size()), again(rays.size());
  paths.start();
  paths.trace(rays, signatures);
  // A second batch of the same rays finds the same sequences, and in another order too.
  std::vector<Vec2> reversed(rays.rbegin(), rays.rend());
  paths.trace(reversed, again);
  std::reverse(again.begin(), again.end());
  EXPECT_EQ(signatures, again);
  std::map<std::uint64_t, int> count;
  for (const std::uint64_t signature : signatures) ++count[signature];
  EXPECT_GT(count.size(), 8u);
  EXPECT_LT(count.size(), 60u);
}

TEST(RayPaths, ThePlateBeforeACornerIsAnObstacleOfTheWallsThatItHides) {
  Scene scene(stepped_corner(), direction(35, 25));
  RayPaths paths(scene.context);
  const std::vector<Vec2> rays = points(scene, 3000, 0.3);
  std::vector<std::uint64_t> signatures(rays.size());
  paths.start();
  paths.trace(rays, signatures);
  paths.finish();
  // The plate is the last part of the mesh.
  const auto is_plate = [&](int facet) { return scene.target.facets()[facet].corner[0].norm() > 0 && facet >= 6; };
  int hidden = 0;
  for (int first = paths.path(0).first_child; first >= 0; first = paths.path(first).next_sibling) {
    EXPECT_TRUE(paths.obstacles(first, 0).empty());  // lit is seen
    for (int second = paths.path(first).first_child; second >= 0; second = paths.path(second).next_sibling) {
      for (const Obstacle& obstacle : paths.obstacles(second, 0)) hidden += is_plate(obstacle.facet);
    }
  }
  EXPECT_GT(hidden, 0);
}

}  // namespace
}  // namespace seaglint

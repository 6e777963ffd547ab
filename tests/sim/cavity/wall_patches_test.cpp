// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/wall_currents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tests/sim/cavity/guide.h"

namespace seaglint {
namespace {

// The inside of a tube about the x axis, of slivers as long as the tube.
TriangleMesh tube(double radius, double length, int sides) {
  MeshBuilder builder;
  builder.begin_part("tube");
  std::vector<std::uint32_t> near, far;
  for (int i = 0; i < sides; ++i) {
    const double at = 2 * kPi * i / sides;
    near.push_back(builder.vertex({0, radius * std::cos(at), radius * std::sin(at)}));
    far.push_back(builder.vertex({length, radius * std::cos(at), radius * std::sin(at)}));
  }
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    builder.quad(near[i], far[i], far[next], near[next]);
  }
  return builder.take();
}

TEST(WallPatches, KeepAreaAndVectorAreaForAnyTriangulation) {
  const TriangleMesh mesh = tube(0.1, 0.5, 300);
  const auto patches = wall_patches(mesh, 0.02);
  double area = 0;
  Vec3 vector = Vec3::Zero(), moment = Vec3::Zero();
  for (const WallPatch& p : patches) {
    area += p.area;
    vector += p.area * p.normal;
    moment += p.area * p.centre;
  }
  EXPECT_NEAR(area, surface_area(mesh), 1e-12);
  EXPECT_LT((moment / area - Vec3(0.25, 0, 0)).norm(), 1e-12);
  EXPECT_LT(vector.norm(), 1e-3 * area);
}

TEST(WallPatches, AreAboutOneSizeAndLieOnTheWall) {
  constexpr double kSize = 0.02, kRadius = 0.1;
  const TriangleMesh mesh = tube(kRadius, 0.5, 300);
  const auto patches = wall_patches(mesh, kSize);
  EXPECT_NEAR(static_cast<double>(patches.size()) * kSize * kSize / surface_area(mesh), 1, 0.25);
  // Seeds lie 0.94 of a size apart at least: a hexagon of 0.77 squares, of which half may be cut by the tube's end; no
  // point is farther than that from a seed, which a hexagon of 2.3 squares would need everywhere.
  for (const WallPatch& p : patches) {
    EXPECT_GT(p.area, 0.3 * kSize * kSize);
    EXPECT_LT(p.area, 2 * kSize * kSize);
    const Vec3 outwards = Vec3(0, p.centre.y(), p.centre.z()).normalized();
    // A patch extends over an arc of at most `kSize` to either side: its centre is off the wall by the arc's height.
    EXPECT_NEAR(Vec3(0, p.centre.y(), p.centre.z()).norm(), kRadius, kSize * kSize / (2 * kRadius));
    EXPECT_GT(-outwards.dot(p.normal), std::cos(kSize / kRadius));
    EXPECT_LT((p.tangent[0].cross(p.tangent[1]) - p.normal).norm(), 1e-12);
  }
}

TEST(WallPatches, EndAtEdges) {
  for (const WallPatch& p : wall_patches(guide(0.3, 0.2, 0.5), 0.013))
    EXPECT_GT(p.normal.cwiseAbs().maxCoeff(), 1 - 1e-9);
}

TEST(WallPatches, RefuseWallsTooLargeForTheWavelength) {
  EXPECT_THROW(wall_patches(guide(3, 2, 5), 0.01), InputError);
  EXPECT_THROW(wall_patches(tube(1e-6, 100, 10'000), 1e-4), InputError);
}

}  // namespace
}  // namespace seaglint

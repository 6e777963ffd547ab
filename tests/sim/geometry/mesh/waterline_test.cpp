// SPDX-License-Identifier: BSD-3-Clause
// The cut at the waterline keeps all area, and every triangle is on one side of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/mesh/waterline.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

TEST(Waterline, KeepsAreaVolumeAndClosednessWithEachTriangleOnOneSide) {
  const TriangleMesh sphere = make_sphere(1, 3);
  for (const double height : {-0.83, -0.2, 0.0, 0.31, 0.9}) {
    const WaterlineCut cut = cut_at_waterline(sphere, height);
    EXPECT_NEAR(surface_area(cut.mesh), surface_area(sphere), 1e-12);
    EXPECT_NEAR(enclosed_volume(cut.mesh), enclosed_volume(sphere), 1e-12);
    const Topology topology = topology_of(welded(cut.mesh));
    EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size()) << height;
    ASSERT_EQ(cut.submerged.size(), cut.mesh.triangles.size());
    double wet = 0;
    for (std::size_t t = 0; t < cut.submerged.size(); ++t) {
      for (const std::uint32_t v : cut.mesh.triangles[t]) {
        const double z = cut.mesh.vertices[v].z();
        EXPECT_TRUE(cut.submerged[t] ? z <= height : z >= height);
      }
      if (cut.submerged[t]) wet += area_vector(cut.mesh, t).norm();
    }
    // Archimedes: the zone below has area 2 pi (1 + height); that of the sphere of 1,280 facets is 1 % smaller.
    EXPECT_NEAR(wet, 2 * 3.14159265358979 * (1 + height), 0.02 * 4 * 3.14159265358979);
  }
}

TEST(Waterline, KeepsAMeshOnTheWaterUnchanged) {
  const WaterlineCut cut = cut_at_waterline(make_plate(0.5, 0.4), -0.2);
  EXPECT_EQ(cut.mesh.triangles.size(), 2u);
  EXPECT_EQ(std::count(cut.submerged.begin(), cut.submerged.end(), true), 0);
}

// The bottom of a body that is read from a file may be above or below the water by a rounding error.
TEST(Waterline, SubmergesABottomOnTheWaterForAnyRounding) {
  for (const double height : {-1.25, -1.3, -1.7, 2.3, 0.1}) {
    for (const double offset : {-2e-7, 0.0, 2e-7}) {
      TriangleMesh cylinder = transformed(make_cylinder(0.5, 1, 12), Mat3::Identity(),
                                          Vec3(0, 0, height + 0.5 + offset * std::abs(height)));
      for (Vec3& p : cylinder.vertices) p = p.cast<float>().cast<double>();
      const WaterlineCut cut = cut_at_waterline(cylinder, height);
      EXPECT_EQ(cut.mesh.triangles.size(), cylinder.triangles.size()) << "nothing is cut";
      for (std::size_t t = 0; t < cut.submerged.size(); ++t) {
        EXPECT_EQ(cut.submerged[t], area_vector(cut.mesh, t).normalized().z() < -0.5)
            << "the bottom alone, height " << height;
      }
    }
  }
}

}  // namespace
}  // namespace seaglint

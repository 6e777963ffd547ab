// SPDX-License-Identifier: BSD-3-Clause
// The cut at the waterline keeps all area, and every triangle is on one side of it; what is above the water is the mesh
// that a draughtsman ends at the waterline.
#include "sim/geometry/placement/waterline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/geometry/mesh_changes.h"

namespace seaglint {
namespace {

using namespace testing_meshes;

// Tube of square cross-section about z, 2 m wide with a shaft of 1 m, from z = -1 to 1.
TriangleMesh tube() {
  MeshBuilder builder;
  for (const double z : {-1.0, 1.0}) {
    for (const double half : {1.0, 0.5})
      for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) builder.vertex({half * x, half * y, z});
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t k = (i + 1) % 4;
    builder.quad(i, k, 8 + k, 8 + i);            // outer side
    builder.quad(4 + k, 4 + i, 12 + i, 12 + k);  // shaft
    builder.quad(k, i, 4 + i, 4 + k);            // below
    builder.quad(8 + i, 8 + k, 12 + k, 12 + i);  // above
  }
  return builder.take();
}

void expect_closed(const TriangleMesh& mesh) {
  const Topology topology = topology_of(mesh);
  EXPECT_EQ(topology.count(EdgeKind::kManifold), topology.edges.size());
  EXPECT_TRUE(topology.degenerate.empty());
}

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

TEST(AboveWater, OfABoxIsTheBoxThatEndsAtTheWaterline) {
  for (const double height : {-0.25, 0.0, 0.5}) {
    const AboveWater above = above_water(box({-5, -2, -1}, {5, 2, 1}), height);
    expect_closed(above.mesh);
    EXPECT_NEAR(enclosed_volume(above.mesh), 40 * (1 - height), 1e-12);
    EXPECT_NEAR(surface_area(above.mesh), 80 + 28 * (1 - height), 1e-12);
    EXPECT_EQ(bounds(above.mesh).lower.z(), height);
    EXPECT_NEAR(above.below.area_m2, 40 + 28 * (1 + height), 1e-12);
    EXPECT_NEAR(above.below.depth_m, 1 + height, 1e-15);
    EXPECT_EQ(above.below.open_m, 0);
  }
}

// Divergence theorem about a point of the water surface, to which a lid adds nothing: V = sum x.A / 3 of the rest.
TEST(AboveWater, OfCurvedBodiesIsClosedWithTheVolumeOfWhatStays) {
  const TriangleMesh bodies[] = {make_sphere(1, 3), make_cylinder(0.6, 2, 33), make_icosahedral_reflector(1)};
  for (const TriangleMesh& body : bodies) {
    for (const double height : {-0.41, -0.123, 0.0, 0.2}) {
      const AboveWater above = above_water(body, height);
      expect_closed(above.mesh);
      EXPECT_EQ(above.below.open_m, 0);
      double volume = 0, flat = 0;
      for (std::size_t t = 0; t < above.mesh.triangles.size(); ++t) {
        const Vec3 area = area_vector(above.mesh, t);
        volume += (above.mesh.vertices[above.mesh.triangles[t][0]] - Vec3(0, 0, height)).dot(area) / 3;
        flat += area.z();
        for (const std::uint32_t v : above.mesh.triangles[t]) EXPECT_GE(above.mesh.vertices[v].z(), height - 1e-9);
      }
      EXPECT_NEAR(enclosed_volume(above.mesh), volume, 1e-12);
      EXPECT_NEAR(flat, 0, 1e-12);  // a closed surface
    }
  }
}

TEST(AboveWater, OfAMoonpoolOrADoubleHullHasALidWithAHole) {
  const AboveWater above = above_water(tube(), 0.25);
  expect_closed(above.mesh);
  EXPECT_NEAR(enclosed_volume(above.mesh), 3 * 0.75, 1e-12);
  EXPECT_NEAR(surface_area(above.mesh), 2 * 3 + (8 + 4) * 0.75, 1e-12);
}

TEST(AboveWater, OfACatamaranHasTwoLids) {
  TriangleMesh hulls = box({-5, -3, -1}, {5, -2, 1});
  hulls.append(box({-5, 2, -1}, {5, 3, 1}));
  const AboveWater above = above_water(hulls, 0);
  expect_closed(above.mesh);
  EXPECT_NEAR(enclosed_volume(above.mesh), 20, 1e-12);
}

// A vertical plate through the water keeps its upper part, with a free edge.
TEST(AboveWater, OfASheetIsASheet) {
  const AboveWater above = above_water(make_plate(2, 1), 0.1);  // z from -0.5 to 0.5
  EXPECT_NEAR(surface_area(above.mesh), 2 * 0.4, 1e-12);
  EXPECT_NEAR(above.below.area_m2, 2 * 0.6, 1e-12);
  EXPECT_EQ(above.below.open_m, 0);
}

TEST(AboveWater, LeavesAMeshThatEndsAtTheWaterlineAsItIsToTheBit) {
  const TriangleMesh hull = box({-5, -2, 0}, {5, 2, 1});
  for (const double rounding : {-3e-7, 0.0, 3e-7}) {
    const AboveWater above = above_water(hull, rounding);
    EXPECT_EQ(above.mesh.vertices, hull.vertices);
    EXPECT_EQ(above.mesh.triangles, hull.triangles);
    EXPECT_EQ(above.below.depth_m, 0);
    EXPECT_EQ(cut_sentence(above.below), "");
  }
}

// A hull drawn to its waterline with a dome below it, and a box with its top in the surface.
TEST(AboveWater, KeepsABottomInTheSurfaceAndRemovesADeckInIt) {
  TriangleMesh hull = box({-5, -2, 0}, {5, 2, 1});
  hull.append(box({-1, -1, -2}, {1, 1, 0}));
  const AboveWater above = above_water(hull, 0);
  EXPECT_NEAR(surface_area(above.mesh) - surface_area(box({-5, -2, 0}, {5, 2, 1})), 0, 4 + 1e-12);
  for (std::size_t t = 0; t < above.mesh.triangles.size(); ++t) {
    const Vec3 area = area_vector(above.mesh, t);
    const bool in_surface = above.mesh.vertices[above.mesh.triangles[t][0]].z() == 0 && area.xy() == Vec2::Zero();
    EXPECT_TRUE(!in_surface || area.z() < 0);
  }
}

TEST(AboveWater, GivesALidThePartAndMaterialOfTheHull) {
  TriangleMesh ship = box({-5, -2, -1}, {5, 2, 1});
  ship.part_names = {"hull", "mast"};
  ship.materials.push_back({"ram"});
  ship.append(box({0, 0, 1}, {0.2, 0.2, 9}));
  for (std::size_t t = 0; t < 12; ++t) ship.triangle_material[t] = 1;
  const AboveWater above = above_water(ship, 0);
  double lid_m2 = 0;
  for (std::size_t t = 0; t < above.mesh.triangles.size(); ++t) {
    if (area_vector(above.mesh, t).z() >= 0 || above.mesh.vertices[above.mesh.triangles[t][0]].z() != 0) continue;
    lid_m2 -= area_vector(above.mesh, t).z();
    EXPECT_EQ(above.mesh.triangle_material[t], 1);
    EXPECT_EQ(above.mesh.part_names[above.mesh.triangle_part[t]], "hull");
  }
  EXPECT_NEAR(lid_m2, 40, 1e-12);
}

TEST(AboveWater, SaysHowMuchIsCut) {
  EXPECT_EQ(cut_sentence(above_water(box({-5, -2, -1}, {5, 2, 1}), 0).below),
            "68 m^2 of its surface, down to 1 m below the water, is cut off at the waterline, z = 0 m of the mesh");
}

}  // namespace
}  // namespace seaglint

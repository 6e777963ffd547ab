// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/make_ship.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

class ShipMesh : public testing::Test {
 protected:
  static void SetUpTestSuite() { mesh = make_combatant(); }
  static void TearDownTestSuite() { mesh = {}; }
  static inline TriangleMesh mesh;
};

TEST_F(ShipMesh, HasItsLengthAndDraught) {
  const Bounds box = bounds(mesh);
  EXPECT_NEAR(box.lower.x(), -72, 0.01);
  EXPECT_NEAR(box.upper.x(), 72, 0.01);
  EXPECT_EQ(box.lower.z(), 0.0);
  EXPECT_GT(box.upper.z(), 25);
  // Not all fittings are in symmetric pairs, but the beam is symmetric.
  EXPECT_NEAR(box.lower.y(), -box.upper.y(), 1e-4);
}

TEST_F(ShipMesh, HasItsBeamAtTheWaterline) {
  double widest = 0;
  for (const Vec3& p : mesh.vertices)
    if (p.z() == 0) widest = std::max(widest, p.y());
  EXPECT_NEAR(2 * widest, 17.5, 0.01);
}

TEST_F(ShipMesh, ConsistsOfClosedPartsThatFaceOutwards) {
  ASSERT_GT(mesh.part_names.size(), 20u);
  for (std::size_t p = 0; p < mesh.part_names.size(); ++p) {
    const TriangleMesh part = part_of(mesh, p);
    const Topology topology = topology_of(part);
    EXPECT_TRUE(topology.part_closed[0]) << mesh.part_names[p];
    EXPECT_TRUE(topology.degenerate.empty()) << mesh.part_names[p];
    EXPECT_GT(enclosed_volume(part), 0) << mesh.part_names[p];
  }
}

// Follows neighbours from triangle to triangle: each solid within a part has its own outward orientation.
TEST_F(ShipMesh, EverySolidWithinAPartFacesOutwards) {
  const Topology topology = topology_of(mesh);
  std::vector<bool> visited(mesh.triangles.size(), false);
  int solids = 0;
  for (std::uint32_t start = 0; start < mesh.triangles.size(); ++start) {
    if (visited[start]) continue;
    double volume = 0;
    const Vec3 origin = mesh.vertices[mesh.triangles[start][0]];
    std::vector<std::uint32_t> pending{start};
    visited[start] = true;
    while (!pending.empty()) {
      const std::uint32_t t = pending.back();
      pending.pop_back();
      volume += (mesh.vertices[mesh.triangles[t][0]] - origin).dot(area_vector(mesh, t)) / 3.0;
      for (std::uint32_t n : topology.neighbours[t]) {
        ASSERT_NE(n, kNoIndex);
        if (!visited[n]) pending.push_back(n);
        visited[n] = true;
      }
    }
    EXPECT_GT(volume, 0) << mesh.part_names[mesh.triangle_part[start]];
    ++solids;
  }
  EXPECT_GT(solids, 500);
}

TEST_F(ShipMesh, HullHasTheVolumeOfItsSections) {
  // Freeboard times mean breadth: 144 m x 17.5 m x about 6.3 m, of which a fine hull fills 0.7 to 0.85.
  const double box = 144 * 17.5 * 6.3, volume = enclosed_volume(part_of(mesh, 0));
  EXPECT_EQ(mesh.part_names[0], "hull");
  EXPECT_GT(volume, 0.70 * box);
  EXPECT_LT(volume, 0.85 * box);
}

// The plates of the hull are small, and their normals vary along the ship and with height, so that no aspect has one
// large specular reflection.
TEST_F(ShipMesh, HullPlatesAreSmallAndOfVaryingNormals) {
  const TriangleMesh hull = part_of(mesh, 0);
  std::vector<double> flare;
  for (std::size_t t = 0; t < hull.triangles.size(); ++t) {
    const Vec3 area = area_vector(hull, t), n = area.normalized();
    if (std::abs(n.z()) > 0.9 || std::abs(n.x()) > 0.8) continue;  // deck and lid, transom
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      longest = std::max(longest,
                         (hull.vertices[hull.triangles[t][(i + 1) % 3]] - hull.vertices[hull.triangles[t][i]]).norm());
    }
    EXPECT_LT(longest, 3.5) << "triangle " << t;
    flare.push_back(degrees(std::asin(n.z())));
  }
  std::sort(flare.begin(), flare.end());
  EXPECT_LT(flare[flare.size() / 20], flare[flare.size() * 19 / 20] - 5.0);
  // The sides lean outwards by several degrees, so that at 2 deg of elevation none faces the radar.
  EXPECT_LT(flare[flare.size() * 3 / 4], -3.0);
}

// Vertices where three faces meet at inner right angles: corner reflectors, which scatter in many directions.
TEST_F(ShipMesh, HasInnerRightAngledVerticesAlongItsLength) {
  const Topology topology = topology_of(mesh);
  std::vector<int> right_seams(mesh.vertices.size(), 0);
  for (const Wedge& wedge : wedges(mesh, topology, radians(45))) {
    if (std::abs(wedge.exterior_angle - 0.5 * kPi) > radians(0.1)) continue;
    for (std::uint32_t v : topology.edges[wedge.edge].vertices) ++right_seams[v];
  }
  int corners = 0;
  std::set<int> slices;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (right_seams[v] < 3) continue;
    ++corners;
    slices.insert(static_cast<int>(std::floor(mesh.vertices[v].x() / 6.0)));
  }
  EXPECT_GE(corners, 240);
  EXPECT_GE(slices.size(), 15u) << "of 24 slices of 6 m";
}

TEST_F(ShipMesh, HasAtMostItsNumberOfTriangles) {
  EXPECT_GE(mesh.triangles.size(), 15000u);
  EXPECT_LE(mesh.triangles.size(), 40000u);
}

TEST(Combatant, DetailAddsParts) {
  const std::size_t hull = make_combatant(ShipDetail::kHull).triangles.size();
  const std::size_t fittings = make_combatant(ShipDetail::kFittings).triangles.size();
  EXPECT_LT(hull, fittings);
  EXPECT_LT(fittings, make_combatant().triangles.size());
}

// The files in assets/ are the output of the generators.

const std::filesystem::path kAssets = std::filesystem::path(SEAGLINT_SOURCE_DIR) / "assets";

void expect_same_bytes(const TriangleMesh& mesh, const char* name) {
  const TemporaryFolder folder;
  const std::filesystem::path again = folder.path() / name;
  write_mesh(again, mesh);
  // EXPECT_EQ would print half a megabyte.
  EXPECT_TRUE(read_file(again) == read_file(kAssets / name))
      << "assets/" << name << " differs from the output of its command in assets/README.md";
}

TEST(Assets, ShipEqualsItsGeneratorsOutput) { expect_same_bytes(make_combatant(), "combatant_144m.glb"); }

TEST(Assets, ReflectorEqualsItsGeneratorsOutput) {
  expect_same_bytes(make_icosahedral_reflector(), "icosahedral_reflector.glb");
}

TEST(Assets, AreSmall) {
  EXPECT_LT(std::filesystem::file_size(kAssets / "combatant_144m.glb"), 1u << 20);
  EXPECT_LT(std::filesystem::file_size(kAssets / "icosahedral_reflector.glb"), 64u << 10);
}

TEST(Assets, HaveTheirChecksums) {
  const std::string command = "cd '" + kAssets.string() + "' && sha256sum --check --strict --quiet SHA256SUMS";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(Assets, AreUnchangedByARoundTripThroughTheirFiles) {
  const TriangleMesh ship = make_combatant(), again = read_mesh(kAssets / "combatant_144m.glb");
  ASSERT_EQ(again.triangles.size(), ship.triangles.size());
  EXPECT_EQ(again.part_names, ship.part_names);
  for (std::size_t t = 0; t < ship.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(again.vertices[again.triangles[t][i]], ship.vertices[ship.triangles[t][i]])
          << "positions lie on a grid that float32 represents exactly";
    }
  }
}

// The hull is smooth between its knuckles; the file rounds normals to float32.
TEST(Assets, HaveTheNormalsOfTheShipsSmoothSurfaces) {
  const TriangleMesh ship = make_combatant(), again = read_mesh(kAssets / "combatant_144m.glb");
  ASSERT_EQ(again.corner_normals.size(), ship.corner_normals.size());
  std::size_t smooth = 0;
  for (std::size_t t = 0; t < ship.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 &n = ship.corner_normals[t][i], own = area_vector(ship, t).normalized();
      smooth += n.isZero(0) ? 0 : 1;
      // A corner without a normal has that of its triangle in the file, or none.
      const Vec3& read = again.corner_normals[t][i];
      EXPECT_LT((read - (n.isZero(0) ? (read.isZero(0) ? Vec3::Zero() : own) : n)).norm(), 1.1e-7);
    }
  }
  EXPECT_GT(smooth, 12000u) << "the hull's triangles";
}

}  // namespace
}  // namespace seaglint

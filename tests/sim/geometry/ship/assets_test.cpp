// SPDX-License-Identifier: BSD-3-Clause
// The files in assets/ are the output of the generators.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/ship/make_ship.h"

namespace seaglint {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(SEAGLINT_SOURCE_DIR) / "assets";

void expect_same_bytes(const TriangleMesh& mesh, const char* name) {
  const std::filesystem::path again =
      std::filesystem::path(testing::TempDir()) / ("seaglint_again_" + std::to_string(::getpid()) + name);
  write_mesh(again, mesh);
  // EXPECT_EQ would print half a megabyte.
  EXPECT_TRUE(read_file(again) == read_file(kAssets / name))
      << "assets/" << name << " differs from the output of its command in assets/README.md";
  std::filesystem::remove(again);
}

TEST(Assets, ShipEqualsItsGeneratorsOutput) { expect_same_bytes(make_ship(), "combatant_144m.glb"); }

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
  const TriangleMesh ship = make_ship();
  const TriangleMesh again = read_mesh(kAssets / "combatant_144m.glb");
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
  const TriangleMesh ship = make_ship(), again = read_mesh(kAssets / "combatant_144m.glb");
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

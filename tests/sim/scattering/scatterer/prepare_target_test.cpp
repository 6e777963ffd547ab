// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/prepare_target.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class PreparedCylinder : public testing::Test {
 protected:
  PreparedCylinder() : folder_(fs::path(testing::TempDir()) / ("prepare_target_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    source_.mesh = folder_ / "cylinder.stl";
    source_.lowest_hz = source_.highest_hz = 10e9;
    TriangleMesh mesh = make_cylinder(0.5, 2, 16);
    mesh.triangles.push_back(mesh.triangles.front());
    mesh.triangle_part.push_back(mesh.triangle_part.front());
    mesh.triangle_material.push_back(mesh.triangle_material.front());
    write_mesh(source_.mesh, mesh);
  }
  ~PreparedCylinder() override { fs::remove_all(folder_); }

  fs::path folder_;
  TargetSource source_;
};

TEST_F(PreparedCylinder, IsRepairedWithAWarning) {
  const PreparedTarget target = prepare_target(load_target_mesh(source_), {});
  EXPECT_EQ(target.mesh.triangles.size(), make_cylinder(0.5, 2, 16).triangles.size());
  EXPECT_FALSE(target.warnings.empty());
  ASSERT_EQ(target.materials.size(), 1u);
  EXPECT_EQ(target.materials.front().kind, SurfaceKind::kPec);
  EXPECT_NEAR(target.scatterer->radius(), std::hypot(0.5, 1.0), 1e-6);
}

TEST_F(PreparedCylinder, HasMaterialsAndAWaterline) {
  source_.materials = {{std::nullopt, SEAGLINT_SOURCE_DIR "/assets/materials/stainless_steel.yaml", ""}};
  ScattererSettings settings;
  settings.waterline_m = 0.25;
  settings.sea_reflects = true;
  const PreparedTarget target = prepare_target(load_target_mesh(source_), settings);
  ASSERT_EQ(target.materials.size(), 2u);
  EXPECT_NE(target.materials[0].kind, SurfaceKind::kPec);
  EXPECT_EQ(target.materials[1].kind, SurfaceKind::kSubmerged);
  for (std::size_t t = 0; t < target.mesh.triangles.size(); ++t) {
    double top = -1e9;
    for (const std::uint32_t v : target.mesh.triangles[t]) top = std::max(top, target.mesh.vertices[v].z());
    EXPECT_EQ(target.mesh.triangle_material[t] == 1, top <= 0.25 + 1e-9);
  }
}

TEST_F(PreparedCylinder, EndsAtTheWaterlineWithoutSeaReflection) {
  ScattererSettings settings;
  settings.waterline_m = 0.25;
  const PreparedTarget target = prepare_target(load_target_mesh(source_), settings);
  ASSERT_EQ(target.materials.size(), 1u);
  EXPECT_NEAR(bounds(target.mesh).lower.z(), 0.25, 1e-9);
}

}  // namespace
}  // namespace seaglint

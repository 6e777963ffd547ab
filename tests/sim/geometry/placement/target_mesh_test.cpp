// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/placement/target_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/material_spec.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

MaterialSpec named(const char* name) {
  MaterialSpec material;
  material.name = name;
  return material;
}

TEST(TargetMesh, NamesThePlaceOfAnError) {
  TargetSource source;
  source.loaded = std::make_shared<const TriangleMesh>(make_cylinder(0.5, 2, 16));
  source.materials_place = "targets.buoy";
  source.materials = {{"mast", "pec", ""}};
  EXPECT_THAT(refusal_of([&] { load_target_mesh(source); }), HasSubstr("targets.buoy: part 'mast'"));
}

TEST(TargetMesh, MaterialsAreAssignedByPartNames) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.append(make_sphere(1, 1));
  ASSERT_EQ(mesh.part_names.size(), 2u);
  MaterialSpec a = named("a"), b = named("b");
  const std::vector<PartMaterial> parts{{"*", a}, {mesh.part_names[1], b}};
  const auto materials = assign_materials(mesh, MaterialSpec{}, parts);
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_EQ(materials[mesh.triangle_material.front()].name, "a");
  EXPECT_EQ(materials[mesh.triangle_material.back()].name, "b");
  const MaterialSpec grp = find_material("grp_sheet", {}, "");
  const std::vector<PartMaterial> wrong{{"mast", a}};
  EXPECT_THROW(assign_materials(mesh, MaterialSpec{}, wrong), InputError);
  EXPECT_THROW(check_frequencies(std::vector{grp}, 16e9, 35e9), InputError);
  EXPECT_NO_THROW(check_frequencies(std::vector{grp}, 16e9, 16.2e9));
}

// Parts come first; the name of the faces without a material is none.
TEST(TargetMesh, MaterialsAreAssignedByTheMaterialsOfTheFileWhereNoPartHasTheName) {
  TriangleMesh file = make_plate(1, 1);
  file.append(make_sphere(1, 1));
  file.materials = {Material{}, Material{"glass"}};
  for (std::size_t t = 0; t < file.triangles.size(); ++t) file.triangle_material[t] = t % 2;
  MaterialSpec a = named("a"), b = named("b");
  const auto assigned = [&](const std::vector<PartMaterial>& choices) {
    TriangleMesh mesh = file;
    const auto materials = assign_materials(mesh, MaterialSpec{}, choices);
    std::string names;
    for (const std::size_t t : {0, 1, 2, 3}) names += materials[mesh.triangle_material[t]].name + ' ';
    return names;
  };
  // The plate has triangles 0 and 1.
  EXPECT_EQ(assigned({{"glass", a}}), "pec a pec a ");
  EXPECT_EQ(assigned({{file.part_names[0], b}, {"gl*", a}}), "b a pec a ");
  EXPECT_EQ(assigned({{"gl*", a}, {file.part_names[0], b}}), "b b pec a ");
  EXPECT_THROW(assigned({{"pec", a}}), InputError);
}

TEST(TargetMesh, IsSilentForAReflectorAt16GHz) {
  EXPECT_THAT(check_target(make_icosahedral_reflector(), 16e9), ElementsAre());
}

TEST(TargetMesh, WarnsOfTargetsTooSmallTooLargeAndTooFar) {
  EXPECT_THAT(check_target(make_sphere(0.0005, 2), 10e9), ElementsAre(HasSubstr("0.0578 wavelengths at 10 GHz")));
  EXPECT_THAT(check_target(make_plate(100e3, 10), 10e9), ElementsAre(HasSubstr("1e+05 m across; is its unit right?")));
  EXPECT_THAT(check_target(transformed(make_sphere(1, 2), Mat3::Identity(), Vec3(50, 0, 0)), 10e9),
              ElementsAre(HasSubstr("from the origin")));
  EXPECT_THROW(check_target(transformed(make_sphere(1, 2), Mat3::Identity(), Vec3(5e3, 0, 0)), 10e9), InputError);
}

TEST(TargetMesh, ReportsTheCostOfMillionsOfTriangles) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.triangles.resize(1'000'000, mesh.triangles[0]);
  EXPECT_THAT(check_target(mesh, 10e9), ElementsAre());
  mesh.triangles.resize(1'500'000, mesh.triangles[0]);
  EXPECT_THAT(check_target(mesh, 10e9),
              ElementsAre(AllOf(HasSubstr("1.5 million triangles: expect 1 to 3 GB of memory"),
                                HasSubstr("about 12 s before the first view and 1 to 33 s for every view"))));
}

// A mesh file with any axes, unit and origin becomes the same mesh in the body frame.

// Axis of a word as the key's meaning says, written out.
Vec3 axis(const std::string& word) {
  const double sign = word[0] == '+' ? 1 : -1;
  return word[1] == 'x' ? Vec3(sign, 0, 0) : word[1] == 'y' ? Vec3(0, sign, 0) : Vec3(0, 0, sign);
}

TEST(MeshPlacement, TurnsForwardToXAndUpToZByARotationForAllTwentyFourPairs) {
  int pairs = 0;
  for (const std::string forward : kMeshAxes) {
    for (const std::string up : kMeshAxes) {
      MeshPlacement placement;
      placement.forward = forward;
      placement.up = up;
      if (forward[1] == up[1]) {
        EXPECT_THROW(rotation_of(placement), InputError) << forward << up;
        continue;
      }
      const Mat3 rotation = rotation_of(placement);
      EXPECT_EQ(rotation * axis(forward), Vec3(1, 0, 0));
      EXPECT_EQ(rotation * axis(up), Vec3(0, 0, 1));
      EXPECT_EQ(rotation.determinant(), 1);  // no mirror image
      ++pairs;
    }
  }
  EXPECT_EQ(pairs, 24);
  MeshPlacement wrong;
  wrong.up = "z";
  EXPECT_THROW(rotation_of(wrong), InputError);
}

// Bow along +y of the file: what is forward of the origin there is forward after it, port stays to port.
TEST(MeshPlacement, IsUnitThenAxesThenScaleThenOffset) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.obj";
  TriangleMesh mesh = make_plate(1, 1);
  mesh.vertices = {Vec3(0, 1000, 0), Vec3(-500, 0, 0), Vec3(0, 0, 250), Vec3(0, 1000, 250)};
  write_mesh(file, mesh);
  MeshPlacement placement;
  placement.unit = "mm";
  placement.forward = "+y";
  placement.scale = 2;
  placement.offset_m = {10, 20, 30};
  const std::vector<Vec3> expected{Vec3(12, 20, 30), Vec3(10, 21, 30), Vec3(10, 20, 30.5), Vec3(12, 20, 30.5)};
  const TriangleMesh read = read_placed_mesh(file, placement);
  ASSERT_EQ(read.vertices.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LT((read.vertices[i] - expected[i]).norm(), 1e-14 * 40) << i;  // roundings of a millimetre's decimal
  EXPECT_EQ(placement_text(placement), "unit mm forward +y up +z scale 2 offset_m 10,20,30");
  EXPECT_EQ(placement_text({}), "unit m");
}

TEST(MeshPlacement, TurnsNormalsWithTheSurface) {
  TriangleMesh sphere = make_sphere(1, 2);
  for (const auto& triangle : sphere.triangles)
    sphere.corner_normals.push_back(
        {sphere.vertices[triangle[0]], sphere.vertices[triangle[1]], sphere.vertices[triangle[2]]});
  MeshPlacement placement;
  placement.forward = "-z";
  placement.up = "+y";
  placement.offset_m = {0, 0, 3};
  const TriangleMesh turned = placed(sphere, placement);
  EXPECT_NEAR(enclosed_volume(turned), enclosed_volume(sphere), 1e-13);
  for (std::size_t t = 0; t < turned.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((turned.corner_normals[t][i] - (turned.vertices[turned.triangles[t][i]] - Vec3(0, 0, 3))).norm(),
                1e-12);
  }
}

TEST(MeshPlacement, OfAnotherScaleKeepsTheWaterline) {
  MeshPlacement placement;
  placement.scale = 2;
  placement.offset_m = {0.5, 0, -1};
  const MeshPlacement large = with_scale(placement, 6);
  EXPECT_EQ(large.scale, 6);
  EXPECT_EQ(large.offset_m, (std::array<double, 3>{1.5, 0, -3}));
  const Bounds small_box = bounds(placed(make_sphere(1, 2), placement)), box = bounds(placed(make_sphere(1, 2), large));
  EXPECT_NEAR(box.lower.z(), 3 * small_box.lower.z(), 1e-12);
}

TEST(MeshPlacement, ByDefaultLeavesTheMeshAsItIsToTheBit) {
  const TriangleMesh sphere = make_sphere(1, 2);
  EXPECT_EQ(placed(sphere, {}).vertices, sphere.vertices);
  MeshPlacement twice;
  twice.scale = 2;
  EXPECT_EQ(placed(sphere, twice).vertices, enlarged(sphere, 2).vertices);
}

}  // namespace
}  // namespace seaglint

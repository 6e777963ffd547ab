// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/placement/target_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/material_file.h"

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
  try {
    load_target_mesh(source);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("targets.buoy: part 'mast'"));
  }
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

}  // namespace
}  // namespace seaglint

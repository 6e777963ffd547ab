// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scenario/material_spec.h"
#include "tests/refusal.h"
#include "tests/sim/geometry/mesh_changes.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using namespace testing_meshes;
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
  EXPECT_HAS(refusal_of([&] { load_target_mesh(source); }), "targets.buoy: part 'mast'");
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
  EXPECT_THROW(check_frequencies(std::vector{grp}, 16e9, 41e9), InputError);
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

// A plate of two faces and a sphere; names of the materials of its faces in turn.
TargetSource source_with(const std::vector<std::string>& names) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.append(make_sphere(1, 1));
  mesh.materials.clear();
  for (const std::string& name : names) mesh.materials.push_back({name});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.triangle_material[t] = static_cast<std::uint16_t>(t % names.size());
  TargetSource source;
  source.loaded = std::make_shared<const TriangleMesh>(std::move(mesh));
  source.lowest_hz = source.highest_hz = 10e9;
  source.all_conductor = "--material '*=pec'";
  return source;
}

// Of the first faces.
std::vector<std::string> names_of(const TargetMesh& target, std::size_t faces) {
  std::vector<std::string> names;
  for (std::size_t t = 0; t < faces; ++t) names.push_back(target.materials[target.mesh.triangle_material[t]].name);
  return names;
}

// Only files of assets/materials by their names: neither paths nor others.
TEST(TargetMesh, HasTheMaterialsThatItsMeshNamesAndSaysSo) {
  TargetSource source = source_with({"pec", "stainless_steel", "painted", "assets/materials/aluminium.yaml"});
  const TargetMesh target = load_target_mesh(source);
  EXPECT_THAT(names_of(target, 4), ElementsAre("pec", "stainless_steel", "pec", "pec"));
  EXPECT_EQ(target.materials[1], find_material("stainless_steel", {}, ""));
  EXPECT_EQ(target.materials_note,
            "materials as the mesh names them: stainless_steel; --material '*=pec' makes every face a perfect "
            "conductor");
  EXPECT_EQ(load_target_mesh(source_with({"pec", "painted"})).materials_note, "");
}

TEST(TargetMesh, HasTheMaterialsOfItsUserWhereTheseMatchAPartOrANameOfTheMesh) {
  TargetSource source = source_with({"stainless_steel", "window_glass"});
  const std::string plate = source.loaded->part_names[0];
  const auto chosen = [&](const std::vector<MaterialChoice>& choices) {
    source.materials = choices;
    return load_target_mesh(source);
  };
  EXPECT_THAT(names_of(chosen({{"window_glass", "pec", ""}}), 4),
              ElementsAre("stainless_steel", "pec", "stainless_steel", "pec"));
  EXPECT_THAT(names_of(chosen({{plate, "aluminium", ""}}), 4),
              ElementsAre("aluminium", "aluminium", "stainless_steel", "window_glass"));
  EXPECT_THAT(names_of(chosen({{"*", "pec", ""}}), 4), ElementsAre("pec", "pec", "pec", "pec"));
  EXPECT_THAT(names_of(chosen({{std::nullopt, "aluminium", ""}}), 4),
              ElementsAre("aluminium", "aluminium", "aluminium", "aluminium"));
  for (const std::optional<std::string>& all : {std::optional<std::string>("*"), std::optional<std::string>()})
    EXPECT_EQ(chosen({{all, "pec", ""}}).materials_note, "");
  EXPECT_EQ(chosen({{plate, "pec", ""}, {"window_glass", "pec", ""}}).materials_note,
            "materials as the mesh names them: stainless_steel; --material '*=pec' makes every face a perfect "
            "conductor");
}

TEST(TargetMesh, OfMaterialsThatItNamesBeyondTheirBandIsRefusedWithTheWayOut) {
  TargetSource source = source_with({"pec", "window_glass"});
  source.highest_hz = 140e9;
  EXPECT_EQ(refusal_of([&] { load_target_mesh(source); }),
            "material window_glass: its source covers 0.1 to 100 GHz, asked for 10 to 140 GHz; the mesh names it: "
            "--material '*=pec' makes every face a perfect conductor");
  source.materials = {{"*", "pec", ""}};
  EXPECT_NO_THROW(load_target_mesh(source));
  source.materials = {{"*", "window_glass", ""}};
  EXPECT_EQ(refusal_of([&] { load_target_mesh(source); }),
            "material window_glass: its source covers 0.1 to 100 GHz, asked for 10 to 140 GHz");
}

TEST(TargetMesh, WithoutPartsAndMaterialsIsAllOfTheMaterialOfAStar) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.part_names.clear(), mesh.triangle_part.clear(), mesh.materials.clear(), mesh.triangle_material.clear();
  const std::vector<PartMaterial> choices{{"*", named("a")}};
  const auto materials = assign_materials(mesh, MaterialSpec{}, choices);
  EXPECT_EQ(materials[mesh.triangle_material[0]].name, "a");
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

// The cut at the waterline keeps all area, and every triangle is on one side of it; what is above the water is the mesh
// that a draughtsman ends at the waterline.

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

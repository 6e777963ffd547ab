// SPDX-License-Identifier: BSD-3-Clause
// Planar faces of a mesh: the same triangles however the faces were cut, and the same surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/facets.h"
#include "tests/sim/geometry/mesh_changes.h"

namespace seaglint {
namespace {

using namespace testing_meshes;

constexpr double kTolerance = 1e-7;  // m

// The triangles as sets of positions, each starting at its smallest corner.
std::multiset<std::array<std::tuple<double, double, double>, 3>> triangles_of(const TriangleMesh& mesh) {
  std::multiset<std::array<std::tuple<double, double, double>, 3>> all;
  for (const auto& triangle : mesh.triangles) {
    std::array<std::tuple<double, double, double>, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& x = mesh.vertices[triangle[i]];
      corner[i] = {x.x(), x.y(), x.z()};
    }
    std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
    all.insert(corner);
  }
  return all;
}

TEST(PlanarFaces, OfABoxAreSixWhateverItsCuts) {
  TriangleMesh cut = box(Vec3::Zero(), {1, 0.7, 0.3});
  for (int i = 0; i < 3; ++i) {
    cut = cut_in_four(cut);
    const PlanarFaces faces = merge_planar_faces(cut, kTolerance);
    EXPECT_EQ(faces.mesh.triangles.size(), 12u);
    EXPECT_EQ(std::set(faces.face.begin(), faces.face.end()).size(), 6u);
    EXPECT_NEAR(enclosed_volume(faces.mesh), 0.21, 1e-15);
  }
}

// A solid with a notch and a plate with a hole: concave faces, faces within faces, and edges with removed vertices on
// one side only.
TEST(PlanarFaces, HaveTheSameTrianglesHoweverTheyWereCutAndNumbered) {
  MeshBuilder builder;
  builder.begin_part("open box");
  add_open_box(builder, {}, {1, 0.8, 0.5}, 0.05);
  builder.begin_part("bar");
  add_bar(builder, {2, 0, 0}, {3, 0.4, 0.2}, 0.1);
  TriangleMesh mesh = builder.take();
  mesh.append(transformed(make_sphere(0.3, 2), Mat3::Identity(), {0, 3, 0}));
  const auto expected = triangles_of(merge_planar_faces(mesh, kTolerance).mesh);
  Random random({1, Stream::kTest, 0});
  for (int i = 0; i < 4; ++i) {
    TriangleMesh other = renumbered(mesh, random);
    for (int cuts = 0; cuts < 1 + i % 2; ++cuts) other = cut_in_four(other);
    other = split_vertices(renumbered(other, random));
    const PlanarFaces faces = merge_planar_faces(other, kTolerance);
    EXPECT_EQ(triangles_of(faces.mesh), expected);
    EXPECT_NEAR(surface_area(faces.mesh), surface_area(mesh), 1e-12);
    EXPECT_EQ(topology_of(faces.mesh).count(EdgeKind::kBoundary), topology_of(welded(mesh)).count(EdgeKind::kBoundary));
  }
}

// Midpoints rounded to float32 leave faces planar within that rounding.
TEST(PlanarFaces, AbsorbRoundingOfCoordinates) {
  const Mat3 turn = axis_rotation(0.7, Vec3(1, 2, 3).normalized());
  TriangleMesh cut = transformed(box(Vec3::Zero(), {1, 0.7, 0.3}), turn, Vec3::Zero());
  for (int i = 0; i < 3; ++i) cut = cut_in_four(cut, true);
  EXPECT_EQ(merge_planar_faces(cut, kTolerance).mesh.triangles.size(), 12u);
}

TEST(PlanarFaces, KeepEveryTriangleOfACurvedSurface) {
  const TriangleMesh sphere = make_sphere(1, 4);
  const PlanarFaces faces = merge_planar_faces(sphere, kTolerance);
  EXPECT_EQ(triangles_of(faces.mesh), triangles_of(sphere));
}

TEST(PlanarFaces, EndWherePartOrMaterialChanges) {
  TriangleMesh plate = cut_in_four(cut_in_four(make_plate(1, 1)));
  plate.part_names = {"left", "right"};
  for (std::size_t t = 0; t < plate.triangles.size(); ++t) {
    const Vec3 centre = (plate.vertices[plate.triangles[t][0]] + plate.vertices[plate.triangles[t][1]] +
                         plate.vertices[plate.triangles[t][2]]) /
                        3;
    plate.triangle_part[t] = centre.y() > 0;
  }
  const PlanarFaces faces = merge_planar_faces(plate, kTolerance);
  EXPECT_EQ(std::set(faces.face.begin(), faces.face.end()).size(), 2u);
  for (const std::size_t part : {0u, 1u}) EXPECT_NEAR(surface_area(part_of(faces.mesh, part)), 0.5, 1e-15);
}

// Three sheets that meet at one edge: its vertices are removed in all of them, or in none.
TEST(PlanarFaces, KeepSheetsJoinedAtNonManifoldEdges) {
  TriangleMesh sheets = make_plate(1, 1);
  const Vec3 side(0, -0.5, 0);
  for (const double angle : {0.9, 2.1}) {
    const Mat3 turn = axis_rotation(angle, Vec3::UnitZ());
    sheets.append(transformed(make_plate(1, 1), turn, side - turn * side));
  }
  TriangleMesh cut = welded(sheets);
  for (int i = 0; i < 2; ++i) cut = cut_in_four(cut);
  const PlanarFaces faces = merge_planar_faces(cut, kTolerance);
  EXPECT_EQ(faces.mesh.triangles.size(), 6u);
  EXPECT_EQ(topology_of(faces.mesh).count(EdgeKind::kNonManifold), 1u);
}

TEST(PlanarFaces, OfDegenerateTrianglesAreHarmless) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({0, 1, 1});
  mesh.vertices.push_back(0.5 * (mesh.vertices[0] + mesh.vertices[1]));
  mesh.triangles.push_back({0, 1, static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
  mesh.triangle_part.resize(mesh.triangles.size(), 0);
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
  EXPECT_NEAR(surface_area(merge_planar_faces(mesh, kTolerance).mesh), 1, 1e-12);
}

}  // namespace
}  // namespace seaglint

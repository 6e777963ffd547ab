// SPDX-License-Identifier: BSD-3-Clause
// Surface normals in files and through the operations on a mesh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/facets.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

class MeshNormals : public MeshFile {};

// A sphere whose corner normals are exact, but for one triangle that has none.
TriangleMesh sphere_with_normals() {
  TriangleMesh mesh = make_sphere(2, 2);
  for (const auto& triangle : mesh.triangles) {
    auto& normals = mesh.corner_normals.emplace_back();
    for (int i = 0; i < 3; ++i) normals[i] = mesh.vertices[triangle[i]].normalized();
  }
  mesh.corner_normals[7] = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  return mesh;
}

// Largest deviation of the given normals from those of a sphere about `centre`.
double error_on_sphere(const TriangleMesh& mesh, const Vec3& centre = Vec3::Zero()) {
  double largest = 0;
  for (std::size_t t = 0; t < mesh.corner_normals.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Vec3& n = mesh.corner_normals[t][i];
      if (!n.isZero(0))
        largest = std::max(largest, (n - (mesh.vertices[mesh.triangles[t][i]] - centre).normalized()).norm());
    }
  }
  return largest;
}

TEST_F(MeshNormals, ArePreservedByFilesAndWelding) {
  const TriangleMesh mesh = sphere_with_normals();
  for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.ply"}) {
    SCOPED_TRACE(name);
    write_mesh(folder / name, mesh);
    const TriangleMesh again = read_mesh(folder / name);
    ASSERT_EQ(again.corner_normals.size(), mesh.triangles.size());
    EXPECT_EQ(again.vertices.size(), mesh.vertices.size()) << "vertices split by normal are welded";
    const bool is_gltf = std::string(name).starts_with("a.gl");
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        // glTF has normals for all vertices of a primitive or for none.
        const Vec3 given = mesh.corner_normals[t][i],
                   expected = is_gltf && given.isZero(0) ? Vec3(area_vector(mesh, t).normalized()) : given;
        // Each component rounded to float32; OBJ and PLY are normalised once more.
        EXPECT_LT((again.corner_normals[t][i] - expected).norm(), is_gltf ? 3 * kFloatRounding : 4e-16);
      }
    }
  }
  write_mesh(folder / "a.stl", mesh);
  EXPECT_TRUE(read_mesh(folder / "a.stl").corner_normals.empty());
}

// The nodes turn, stretch and mirror: normals of an ellipsoid are the gradient of its quadric.
TEST_F(MeshNormals, OfGltfAreTransformedByTheInverseTranspose) {
  TriangleMesh mesh = sphere_with_normals();
  mesh.corner_normals[7] = mesh.corner_normals[8];
  for (int i = 0; i < 3; ++i) mesh.corner_normals[7][i] = mesh.vertices[mesh.triangles[7][i]].normalized();
  write_mesh(folder / "a.gltf", mesh);
  std::string text = bytes_of(folder / "a.gltf");
  const std::string node = "\"mesh\":0";
  const std::size_t at = text.find(node);
  ASSERT_NE(at, std::string::npos);
  text.insert(at, "\"scale\":[3,-1,0.5],");
  const TriangleMesh placed = read_mesh(put("b.gltf", text));
  ASSERT_EQ(placed.corner_normals.size(), placed.triangles.size());
  for (std::size_t t = 0; t < placed.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      // glTF's x, y, z are y, z, x of the body.
      const Vec3& p = placed.vertices[placed.triangles[t][i]];
      const Vec3 gradient(p.x() / 0.25, p.y() / 9, p.z());
      EXPECT_LT((placed.corner_normals[t][i] - gradient.normalized()).norm(), 40 * kFloatRounding);
    }
    EXPECT_GT(placed.corner_normals[t][0].dot(area_vector(placed, t)), 0);
  }
}

// glTF 2.0, section 3.7.2.1: a primitive without NORMAL is flat. The ship has primitives of both kinds.
TEST_F(MeshNormals, OfPrimitivesWithoutThemAreFlatInGltf) {
  const TriangleMesh ship = read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb");
  EXPECT_EQ(diagnose(ship).corners_without_normal, 0u);
  std::size_t flat = 0;
  for (std::size_t t = 0; t < ship.triangles.size(); ++t) flat += normal_deviation(ship, t) < kNormalDigits ? 1 : 0;
  EXPECT_GT(flat, ship.triangles.size() / 2);
  EXPECT_LT(flat, ship.triangles.size());
}

TEST_F(MeshNormals, ThatAreInvalidRefuseNoFileAndAreCounted) {
  const TriangleMesh mesh = read_mesh(put("a.obj",
                                          "v 0 0 0\nv 2 0 0\nv 0 1 0\nvn 0 0 5\nvn nan 0 1\nvn 0 0\n"
                                          "f 1//1 2//1 3//-3\nf 1//2 2//3 3//9\nf 1 2/1 3/1/x\n"));
  ASSERT_EQ(mesh.corner_normals.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(mesh.corner_normals[0][i], Vec3(Vec3::UnitZ()));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(mesh.corner_normals[1][i].isZero(0) && mesh.corner_normals[2][i].isZero(0));
  EXPECT_EQ(diagnose(mesh).corners_without_normal, 6u);
  EXPECT_THAT(diagnostic_messages(diagnose(mesh)), testing::Contains(testing::HasSubstr("6 of 9 corners")));

  const TriangleMesh ply = read_mesh(put(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0 1e-3\n1 0 0 nan 0 0\n0 1 0 0 0 0\n3 0 1 2\n"));
  ASSERT_EQ(ply.corner_normals.size(), 1u);
  EXPECT_EQ(ply.corner_normals[0][0], Vec3(Vec3::UnitZ()));
  EXPECT_EQ(diagnose(ply).corners_without_normal, 2u);
}

TEST_F(MeshNormals, FollowTheOperationsOnAMesh) {
  TriangleMesh mesh = sphere_with_normals();
  const Mat3 R = axis_rotation(0.8, Vec3(1, -1, 2).normalized());
  const Vec3 shift(3, 1, -0.5);
  EXPECT_LT(error_on_sphere(transformed(mesh, R, shift), shift), 1e-14);

  // Inside out: the repair turns triangles and normals.
  TriangleMesh inverted = mesh;
  for (std::size_t t = 0; t < inverted.triangles.size(); ++t) {
    std::swap(inverted.triangles[t][1], inverted.triangles[t][2]);
    const auto n = mesh.corner_normals[t];
    inverted.corner_normals[t] = {-n[0], -n[2], -n[1]};
  }
  EXPECT_LT(error_on_sphere(repair(inverted)), 1e-15);
  EXPECT_EQ(repair(inverted).corner_normals.size(), mesh.triangles.size());

  TriangleMesh both = make_plate(1, 1);
  both.append(mesh);
  both.append(make_plate(1, 1));
  ASSERT_EQ(both.corner_normals.size(), both.triangles.size());
  EXPECT_LT(error_on_sphere(both), 1e-15);
  EXPECT_TRUE(both.corner_normals.front()[0].isZero(0) && both.corner_normals.back()[0].isZero(0));

  // Interpolated along a side of 0.57 rad: half the second difference of a unit vector, 0.57^2 / 8, at most.
  const WaterlineCut cut = cut_at_waterline(mesh, 0.123);
  ASSERT_EQ(cut.mesh.corner_normals.size(), cut.mesh.triangles.size());
  EXPECT_LT(error_on_sphere(cut.mesh), 0.57 * 0.57 / 8);
  for (const auto& normals : cut.mesh.corner_normals) {
    for (const Vec3& n : normals) EXPECT_TRUE(n.isZero(0) || std::abs(n.norm() - 1) < 1e-15);
  }
}

// On a sphere the rule is exact; a cylinder's caps stay flat, and its side has the normals of the circle.
TEST_F(MeshNormals, ByCreaseAngleFollowSmoothSurfacesAndStopAtEdges) {
  TriangleMesh sphere = make_sphere(2, 3);
  sphere.corner_normals = crease_normals(sphere, radians(20));
  EXPECT_LT(error_on_sphere(sphere), 1e-13);
  TriangleMesh cylinder = make_cylinder(1, 2, 36);
  cylinder.corner_normals = crease_normals(cylinder, radians(20));
  for (std::size_t t = 0; t < cylinder.triangles.size(); ++t) {
    const Vec3 facet = area_vector(cylinder, t).normalized();
    for (int i = 0; i < 3; ++i) {
      Vec3 expected = cylinder.vertices[cylinder.triangles[t][i]];
      expected.z() = 0;
      if (std::abs(facet.z()) > 0.5) {
        EXPECT_TRUE(cylinder.corner_normals[t][i].isZero(0)) << "a flat fan";
      } else {
        EXPECT_LT((cylinder.corner_normals[t][i] - expected.normalized()).norm(), 1e-14);
      }
    }
  }
  for (const auto& normals : crease_normals(make_sphere(2, 1), 0)) {
    for (const Vec3& n : normals) EXPECT_TRUE(n.isZero(0)) << "every triangle is flat";
  }
}

}  // namespace
}  // namespace seaglint

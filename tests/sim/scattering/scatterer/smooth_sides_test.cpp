// SPDX-License-Identifier: BSD-3-Clause
// Which facets are samples of a smooth surface, decided by their shape.
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/surface/smooth_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "sim/geometry/mesh/planar_faces.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/measured.h"
#include "tests/sim/geometry/mesh_changes.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;
using namespace testing_meshes;

// Fraction, by length, of the sides with a turn of less than the crease angle, planar faces excluded, that are smooth.
double smooth_fraction(const TriangleMesh& mesh) {
  const PlanarFaces faces = merge_planar_faces(mesh, 1e-7);
  const std::vector<Facet> facets = make_facets(faces.mesh, faces.face);
  const double crease = radians(kDefaultCreaseDeg);
  const SmoothSides turn = smooth_sides_by_angle(facets, crease), smooth = smooth_sides_by_shape(facets, crease);
  double all = 0, found = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (turn[f][e] < 0 || facets[f].face == facets[static_cast<std::size_t>(turn[f][e])].face) continue;
      const double length = (facets[f].corner[(e + 1) % 3] - facets[f].corner[e]).norm();
      all += length;
      if (smooth[f][e] >= 0) found += length;
    }
  }
  return all > 0 ? found / all : 0;
}

// Vertices displaced along the surface of a unit sphere by up to a third of a side: facets of irregular shape.
TriangleMesh irregular_sphere(int subdivisions) {
  TriangleMesh sphere = make_sphere(1, subdivisions);
  Random random({3, Stream::kTest, 0});
  const double side = 1.1 / std::pow(2, subdivisions);
  for (Vec3& x : sphere.vertices) {
    for (int i = 0; i < 3; ++i) x[i] += 0.1 * side * random.normal();
    x.normalize();
  }
  return sphere;
}

TEST(SmoothSides, OfRoundBodiesAreAllSmooth) {
  for (const TriangleMesh& body :
       {make_sphere(1, 3), cut_in_four(make_sphere(1, 3)), irregular_sphere(3), scaled(make_sphere(1, 4), {3, 1, 0.5}),
        make_cylinder(0.5, 1, 48), cut_in_four(make_cylinder(0.5, 1, 48))})
    EXPECT_EQ(smooth_fraction(body), 1);
}

// A quarter-round of six strips between two large faces: the strips hang together, and so do the first and the last
// with the face beside them.
TEST(SmoothSides, OfAFilletJoinItToTheFaces) {
  const double radius = 0.1;
  TriangleMesh mesh;
  const auto column = [&](double x, double y) {
    mesh.vertices.push_back({x, y, 0});
    mesh.vertices.push_back({x, y, 1});
  };
  column(0, -0.5);
  for (int i = 0; i <= 6; ++i)
    column(-radius * (1 - std::cos(radians(15.0 * i))), 0.5 + radius * std::sin(radians(15.0 * i)));
  column(-0.8, 0.6);
  for (std::uint32_t i = 0; i + 3 < mesh.vertices.size(); i += 2) {
    mesh.triangles.push_back({i, i + 2, i + 3});
    mesh.triangles.push_back({i, i + 3, i + 1});
  }
  EXPECT_EQ(smooth_fraction(mesh), 1);
  EXPECT_EQ(smooth_fraction(cut_in_four(mesh)), 1);
}

// Facets of 2 cm with vertices 0.1 mm off the planes of a trihedral: turns of either sign, no surface.
TEST(SmoothSides, OfRoughPlanesAreKnuckles) {
  TriangleMesh mesh = make_square_trihedral(1);
  for (int i = 0; i < 6; ++i) mesh = cut_in_four(mesh);
  Random random({5, Stream::kTest, 0});
  const double fraction = smooth_fraction(with_noise(mesh, 1e-4, random));
  std::printf("smooth fraction of a rough trihedral: %.4f\n", fraction);
  record_figure(fraction, 4, "smooth_fraction_rough_trihedral");
  EXPECT_LT(fraction, 0.01);
}

// A single knuckle of 10 deg between two flat plates, as between strakes of a hull.
TEST(SmoothSides, AKnuckleStaysAKnuckle) {
  TriangleMesh mesh = make_plate(1, 1);
  const Vec3 hinge(0, 0.5, 0);
  const Mat3 turn = axis_rotation(radians(10), Vec3::UnitZ());
  mesh.append(transformed(make_plate(1, 1), turn, hinge + turn * hinge));
  EXPECT_EQ(smooth_fraction(welded(mesh)), 0);
  EXPECT_EQ(smooth_fraction(cut_in_four(cut_in_four(welded(mesh)))), 0);
}

// Each corner's normal is that of the body at its vertex.
TriangleMesh with_normals(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& normal) {
  for (const auto& triangle : mesh.triangles) {
    auto& normals = mesh.corner_normals.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) normals[i] = normal(mesh.vertices[triangle[i]]);
  }
  return mesh;
}

// Normals of a file are believed where they agree with its facets and say more than these: a sphere of 80 facets, whose
// sides turn by more than any crease angle, is smooth by them.
TEST(SmoothSides, FollowTheNormalsOfTheFile) {
  const auto radial = [](const Vec3& x) { return Vec3(x.normalized()); };
  const TriangleMesh sphere = with_normals(make_sphere(1, 1), radial);
  EXPECT_TRUE(normals_describe_surface(sphere));
  EXPECT_EQ(Scatterer(sphere).surface().curved_count(), 80u);
  EXPECT_EQ(Scatterer(make_sphere(1, 1)).surface().curved_count(), 0u);
  const Scatterer smooth(sphere);
  for (const auto& sides : smooth.edges().edges_of_facet) {
    for (const int edge : sides) EXPECT_EQ(edge, kNoEdge) << "sides inside a smooth surface do not diffract";
  }
  EXPECT_EQ(Scatterer(sphere, {}, 0.0).surface().curved_count(), 0u) << "a crease angle overrides normals";
}

TEST(SmoothSides, IgnoreNormalsThatShadeABoxOrRepeatTheFacets) {
  MeshBuilder builder;
  builder.begin_part("box");
  add_box(builder, {}, {1, 1, 1});
  const TriangleMesh shaded = with_normals(builder.take(), [](const Vec3& x) { return Vec3(x.normalized()); });
  EXPECT_FALSE(normals_describe_surface(shaded));
  EXPECT_EQ(Scatterer(shaded).surface().curved_count(), 0u);
  TriangleMesh sphere = make_sphere(1, 3);
  for (std::size_t t = 0; t < sphere.triangles.size(); ++t)
    sphere.corner_normals.emplace_back().fill(area_vector(sphere, t).normalized());
  EXPECT_FALSE(normals_describe_surface(sphere));
  EXPECT_EQ(Scatterer(sphere).surface().curved_count(), 1280u) << "the shape decides";
}

}  // namespace
}  // namespace seaglint

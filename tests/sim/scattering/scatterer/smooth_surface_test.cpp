// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <set>
#include <tuple>

#include "sim/core/numbers/rotation.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/facets.h"
#include "sim/geometry/surface/smooth_surface.h"
#include "tests/measured.h"
#include "tests/sim/geometry/mesh_changes.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;
using namespace testing_meshes;

// Which facets are samples of a smooth surface, decided by their shape.

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
  for (const auto& sides : smooth.edges().edges_of_facet)
    for (const int edge : sides) EXPECT_EQ(edge, kNoEdge) << "sides inside a smooth surface do not diffract";
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

// Smooth surfaces with as many facets as their curvature requires.

const double kTolerance = merging_tolerance(10e9);

MergedFacets merged(const TriangleMesh& mesh) {
  std::vector<Facet> facets = make_facets(mesh);
  SmoothSides smooth = smooth_sides_by_shape(facets, radians(kDefaultCreaseDeg));
  return merge_smooth_facets(std::move(facets), std::move(smooth), kTolerance);
}

// Of the unit sphere of 20 x 4^n facets, the part above z = 0.8.
TriangleMesh cap(int subdivisions) {
  TriangleMesh mesh = make_sphere(1, subdivisions);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::ranges::any_of(t, [&](std::uint32_t v) { return mesh.vertices[v].z() < 0.8; });
  });
  mesh.triangle_part.resize(mesh.triangles.size());
  mesh.triangle_material.resize(mesh.triangles.size());
  return mesh;
}

std::size_t count_of_sides(const MergedFacets& surface, bool smooth) {
  std::size_t count = 0;
  for (const auto& sides : surface.smooth)
    for (const std::int32_t g : sides) count += (g >= 0) == smooth;
  return count;
}

double area(const std::vector<Facet>& facets) {
  double sum = 0;
  for (const Facet& facet : facets)
    sum += 0.5 * (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]).norm();
  return sum;
}

// Relative difference of the echo with merged facets from that of the mesh, over 16 frequencies from 8 to 10 GHz, dB.
double change_db(const TriangleMesh& mesh, const Vec3& r_hat, int bounces) {
  std::vector<double> k;
  for (int q = 0; q < 16; ++q) k.push_back(wavenumber(8e9 + 2e9 * q / 15));
  const TracingSettings settings{0, bounces};
  const BistaticGeometry geometry = monostatic(radar_basis(r_hat));
  const auto fine = scattering_matrices(Scatterer(mesh), geometry, k, settings);
  const auto coarse = scattering_matrices(Scatterer(mesh, {}, std::nullopt, 0, kTolerance), geometry, k, settings);
  RelativeError error;
  error.add_co_polar(coarse, fine);
  return error.db();
}

TEST(MergedFacets, OfARoundBodyAreAsManyForAFineMeshAsForAFinerOne) {
  const std::size_t fine = merged(cap(6)).facets.size(), finer = merged(cap(7)).facets.size();
  std::printf("cap of %zu and %zu facets: %zu and %zu merged\n", cap(6).triangles.size(), cap(7).triangles.size(), fine,
              finer);
  EXPECT_LT(static_cast<double>(finer), 1.3 * static_cast<double>(fine));
  EXPECT_LT(finer, cap(7).triangles.size() / 6);
  // Its facets are tilted by 2.3 deg.
  EXPECT_EQ(merged(make_sphere(1, 4)).facets.size(), 5'120u);
}

TEST(MergedFacets, FormAClosedSurfaceOfVerticesOfTheMesh) {
  const TriangleMesh mesh = scaled(make_sphere(1, 6), {2, 1, 0.7});
  const MergedFacets surface = merged(mesh);
  EXPECT_LT(surface.facets.size(), mesh.triangles.size() / 2);
  std::set<std::tuple<double, double, double>> vertices;
  for (const Vec3& x : mesh.vertices) vertices.insert({x.x(), x.y(), x.z()});
  const std::vector<Facet> facets = make_facets(mesh);
  EXPECT_EQ(count_of_sides(surface, false),
            count_of_sides({facets, smooth_sides_by_shape(facets, radians(kDefaultCreaseDeg))}, false));
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Facet& facet = surface.facets[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& x = facet.corner[i];
      EXPECT_EQ(vertices.count({x.x(), x.y(), x.z()}), 1u);
      // Gradient of the ellipsoid's equation; the normals are means over facets of the fine mesh, stretched by 3.
      const Vec3 normal = Vec3(x.x() / 4, x.y(), x.z() / 0.49).normalized();
      EXPECT_GE(facet.normal.dot(normal), std::cos(1.2 * kMaxFacetTilt));
      if (!facet.corner_normal[i].isZero(0)) {
        EXPECT_LT((facet.corner_normal[i] - normal).norm(), 5e-3);
      }
      EXPECT_GE(facet.neighbour[i], 0);
    }
  }
}

// Largest distances from the unit sphere, m: of points on the facets raised by the height of the surface over them, at
// all facets and above z = 0.82, and of the facets themselves there.
struct Distances {
  double all = 0, inside = 0, flat = 0;
};
Distances distances_from_sphere(const MergedFacets& surface) {
  const SmoothSurface smooth(surface.facets, surface.smooth, 0);
  Distances largest;
  for (int f = 0; f < static_cast<int>(surface.facets.size()); ++f) {
    const Facet& facet = surface.facets[static_cast<std::size_t>(f)];
    const bool at_rim = std::ranges::any_of(facet.corner, [](const Vec3& x) { return x.z() < 0.82; });
    const std::array<double, 3>& s = smooth.curved(f)->sagitta;
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; i + j <= 8; ++j) {
        const double b = i / 8.0, c = j / 8.0, a = 1 - b - c;
        const double height = 4 * (s[0] * a * b + s[1] * b * c + s[2] * c * a);
        const Vec3 x = a * facet.corner[0] + b * facet.corner[1] + c * facet.corner[2];
        const double error = std::abs((x + height * facet.normal).norm() - 1);
        largest.all = std::max(largest.all, error);
        if (at_rim) continue;
        largest.inside = std::max(largest.inside, error);
        largest.flat = std::max(largest.flat, 1 - x.norm());
      }
    }
  }
  return largest;
}

// Independent of the merging, against the sphere itself. Away from the rim the error is that of quadratic facets, 45 mm
// to the fourth / 128 = 3e-8 m, and of the normals of the fine mesh; at the rim those are one-sided, so that the fine
// mesh has an error of its own there, to which merging adds the tolerance.
TEST(MergedFacets, AreAsHighAsTheSurfaceThatTheyReplace) {
  const std::vector<Facet> facets = make_facets(cap(7));
  const SmoothSides smooth = smooth_sides_by_shape(facets, radians(kDefaultCreaseDeg));
  const Distances fine = distances_from_sphere({facets, smooth}),
                  coarse = distances_from_sphere(merge_smooth_facets(facets, smooth, kTolerance));
  std::printf("largest distance from the sphere %.2f um, at the rim %.1f (fine mesh %.1f) um, of flat facets %.0f um\n",
              1e6 * coarse.inside, 1e6 * coarse.all, 1e6 * fine.all, 1e6 * coarse.flat);
  EXPECT_LE(coarse.inside, 1e-6);
  EXPECT_LE(coarse.all, fine.all + kTolerance);
  EXPECT_GE(coarse.flat, 1e-4);
}

TEST(MergedFacets, LeaveFlatBodiesKnucklesAndFreeEdgesAsTheyAre) {
  const TriangleMesh reflector = make_icosahedral_reflector();
  const MergedFacets flat = merged(reflector);
  EXPECT_EQ(flat.facets.size(), make_facets(reflector).size());

  const TriangleMesh cylinder = make_cylinder(0.5, 2, 600);
  const std::vector<Facet> before = make_facets(cylinder);
  const MergedFacets after = merged(cylinder);
  EXPECT_EQ(after.facets.size(), before.size());  // all vertices are on the rims

  const std::vector<Facet> facets = make_facets(cap(7));
  const SmoothSides smooth = smooth_sides_by_shape(facets, radians(kDefaultCreaseDeg));
  const MergedFacets open = merged(cap(7));
  EXPECT_EQ(count_of_sides(open, false), count_of_sides({facets, smooth}, false));
  EXPECT_NEAR(area(open.facets) / area(facets), 1, kMaxFacetTilt * kMaxFacetTilt);
  for (const Facet& facet : open.facets) EXPECT_TRUE(facet.two_sided);
}

TEST(MergedFacets, KeepTheBordersOfPartsAndMaterials) {
  TriangleMesh mesh = make_sphere(1, 6);
  mesh.part_names = {"port", "starboard"};
  mesh.materials = {{}, {"paint"}};
  std::size_t border = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const bool starboard = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]).y() < 0;
    mesh.triangle_part[t] = mesh.triangle_material[t] = starboard ? 1 : 0;
  }
  const std::vector<Facet> fine = make_facets(mesh);
  const auto length_of_border = [](const std::vector<Facet>& facets) {
    double length = 0;
    for (const Facet& facet : facets) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Facet& across = facets[static_cast<std::size_t>(facet.neighbour[i])];
        if (across.part != facet.part) length += (facet.corner[(i + 1) % 3] - facet.corner[i]).norm();
      }
    }
    return length;
  };
  const MergedFacets surface = merged(mesh);
  EXPECT_NEAR(length_of_border(surface.facets), length_of_border(fine), 1e-9);
  EXPECT_LT(surface.facets.size(), fine.size() / 2);
  for (const Facet& facet : surface.facets) {
    EXPECT_EQ(facet.part, facet.material);
    border += facet.part;
  }
  EXPECT_GT(border, 0u);
}

// Paths that go on from a curved reflector to a plate are the most sensitive to the size of facets: with 20,480 and
// 5,120 facets the echo over the plate differs by -22 and -20 dB.
TEST(MergedFacets, HaveTheEchoOfTheFineMesh) {
  const TriangleMesh body = scaled(make_sphere(0.5, 6), {1.5, 1, 1});
  TriangleMesh over_plate = body;
  over_plate.append(transformed(make_plate(2, 2), axis_rotation(-kPi / 2, Vec3::UnitY()), Vec3(0.9, 0, -0.8)));
  // A cylinder of 1 m with round ends.
  TriangleMesh capsule = make_sphere(0.5, 6);
  for (Vec3& x : capsule.vertices)
    if (std::abs(x.x()) > 1e-9) x.x() += std::copysign(0.5, x.x());
  const double broadside_db = change_db(capsule, direction(88, 3), 1);
  const double alone_db = change_db(body, direction(20, 25), 1),
               over_plate_db = change_db(over_plate, direction(20, 25), 2);
  std::printf("relative to the echo of 81,920 facets: ellipsoid %.1f dB, over a plate %.1f dB, capsule %.1f dB\n",
              alone_db, over_plate_db, broadside_db);
  RecordProperty("alone_db", std::to_string(alone_db));
  RecordProperty("over_plate_db", std::to_string(over_plate_db));
  RecordProperty("broadside_db", std::to_string(broadside_db));
  EXPECT_LT(broadside_db, -52);
  EXPECT_LT(alone_db, -55);
  EXPECT_LT(over_plate_db, -30);
}

TEST(MergedFacets, StayAsMeshedWithACreaseAngleAndWithoutATolerance) {
  const TriangleMesh mesh = cap(7);
  EXPECT_EQ(Scatterer(mesh).facets().size(), mesh.triangles.size());
  EXPECT_EQ(Scatterer(mesh, {}, 0.3, 0, kTolerance).facets().size(), mesh.triangles.size());
  EXPECT_LT(Scatterer(mesh, {}, std::nullopt, 0, kTolerance).facets().size(), mesh.triangles.size() / 4);
}

TEST(MergedFacets, AreTheSameForNeighbouringBands) {
  EXPECT_EQ(merging_tolerance(10e9), merging_tolerance(12e9));
  for (const double hz : {1e9, 3e9, 9.4e9, 16e9, 35e9, 94e9}) {
    const double fraction = kSpeedOfLight / hz / merging_tolerance(hz);
    EXPECT_GE(fraction, 2000);
    EXPECT_LT(fraction, 4000);
  }
}

}  // namespace
}  // namespace seaglint

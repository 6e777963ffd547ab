// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Indexed triangle mesh. It holds any triangle soup, non-manifold ones included.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct Material {
  std::string name = "pec";  // perfect electric conductor; other names are defined by material files
};

// Lengths in metres, body frame (CONVENTIONS.md): x forward, y to port, z up. Triangles are counter-clockwise seen from
// outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint16_t> triangle_part;      // index into part_names, one per triangle
  std::vector<std::uint16_t> triangle_material;  // index into materials, one per triangle
  std::vector<std::string> part_names;
  std::vector<Material> materials;
  // Normals of the surface that the mesh samples, at the three corners of each triangle: unit vectors, outwards, or
  // zero where none is given. Empty: no normals at all.
  std::vector<std::array<Vec3, 3>> corner_normals;
  // What its file has that the mesh lacks or has differently, a sentence each.
  std::vector<std::string> findings{};

  // Appends a mesh unchanged; its parts and materials are matched by name.
  void append(const TriangleMesh& other);
};

// The unit vector along a surface normal of a file; zero where that is not finite or has no length.
Vec3 unit_normal(const Vec3& normal);

struct Bounds {
  Vec3 lower = Vec3::Zero();
  Vec3 upper = Vec3::Zero();
};
// Bounding box of the vertices that triangles use; zero for a mesh without triangles.
Bounds bounds(const TriangleMesh& mesh);

// Half the cross product of two sides: its direction is the outward normal, its length the area in m^2.
Vec3 area_vector(const TriangleMesh& mesh, std::size_t triangle);

// Largest angle between a triangle's corner normals and its own, rad; 0 without. Below kNormalDigits, the digits of
// normals in files, they repeat the triangle.
double normal_deviation(const TriangleMesh& mesh, std::size_t triangle);
inline constexpr double kNormalDigits = 1e-3;

// Sum of the triangles' areas, m^2.
double surface_area(const TriangleMesh& mesh);

// Divergence theorem, V = 1/3 sum x.A: the volume of a closed mesh in m^3, positive when its triangles face outwards.
double enclosed_volume(const TriangleMesh& mesh);

// The mesh moved by p -> R p + t, R a rotation.
TriangleMesh transformed(const TriangleMesh& mesh, const Mat3& rotation, const Vec3& translation);

// The mesh enlarged about its origin: p -> factor p, factor > 0.
TriangleMesh enlarged(TriangleMesh mesh, double factor);

// Index of the first vertex at the same position, for every vertex; -0 and +0 are one coordinate.
std::vector<std::uint32_t> first_at_position(std::span<const Vec3> vertices);

// The same triangles with vertices at identical positions merged (and unused ones dropped), vertices in order of first
// use. Files repeat a vertex per triangle (STL) or per normal (glTF); topology_of() needs it once.
TriangleMesh welded(const TriangleMesh& mesh);

// The triangles of one part, its vertices renumbered; `part` indexes part_names.
TriangleMesh part_of(const TriangleMesh& mesh, std::size_t part);

struct Sphere {
  Vec3 centre = Vec3::Zero();
  double radius = 0;  // m
};

// The smallest sphere that contains all points, to rounding: no point lies outside by more than 1e-12 of the radius. It
// turns and moves with the points. Zero for no points, or where none has numbers as coordinates.
Sphere bounding_sphere(std::span<const Vec3> points);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Indexed triangle mesh, which holds any triangle soup, non-manifold ones included; meshes made part by part, as every
// generator and reader does, and from other meshes.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/random.h"

namespace seaglint {

struct Material {
  std::string name = "pec";  // perfect electric conductor; other names are defined by material files
};

// Of a triangle without normals at its corners.
inline constexpr std::array<Vec3, 3> kNoNormals{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

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

  // The normals at the corners of a triangle; kNoNormals without.
  const std::array<Vec3, 3>& normals_of(std::size_t t) const {
    return corner_normals.empty() ? kNoNormals : corner_normals[t];
  }
  // Removes all triangles with what belongs to them; vertices, names and materials stay.
  void clear_triangles();
  // Appends a triangle of these corners and normals with part and material of triangle t of another mesh, which has the
  // same names, as far as that mesh has parts, materials and normals.
  void add_like(const TriangleMesh& other, std::size_t t, const std::array<std::uint32_t, 3>& corners,
                const std::array<Vec3, 3>& normals);
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

class MeshBuilder {
 public:
  // Part or material of the triangles that follow; a name that was used before is continued.
  void begin_part(const std::string& name);
  void begin_material(const std::string& name);

  std::uint32_t vertex(const Vec3& position) {
    mesh_.vertices.push_back(position);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  // Vertices counter-clockwise seen from outside.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  // With the surface's normals at its corners, of any length; one that is not finite or zero is none.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const std::array<Vec3, 3>& normals);
  // Two triangles a b c, a c d.
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }

  std::size_t part_count() const { return mesh_.part_names.size(); }
  std::size_t triangle_count() const { return mesh_.triangles.size(); }
  const std::vector<Vec3>& vertices() const { return mesh_.vertices; }

  TriangleMesh take();

 private:
  TriangleMesh mesh_;
  std::unordered_map<std::string, std::size_t> part_of_name_, material_of_name_;
  std::uint16_t part_ = 0;
  std::uint16_t material_ = 0;
};

// Other meshes of the same surface: cut, numbered or rounded differently, with noise on the vertices. Parts, materials
// and corner normals are kept.

// Every triangle cut into four at the midpoints of its sides, which are rounded to float32 on request. The normal at a
// midpoint is the mean of those at both ends.
TriangleMesh cut_in_four(const TriangleMesh& mesh, bool as_float = false);

// Vertices and triangles in random order, triangles starting at a random corner.
TriangleMesh renumbered(const TriangleMesh& mesh, Random& random);

// Vertices displaced by a normal distribution of this standard deviation in every coordinate, m.
TriangleMesh with_noise(const TriangleMesh& mesh, double sigma, Random& random);

}  // namespace seaglint

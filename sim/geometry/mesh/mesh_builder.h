// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Meshes made from parts, as every generator and reader does, and from other meshes of the same surface.

#include <array>
#include <string>
#include <unordered_map>

#include "sim/core/numbers/random.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

class MeshBuilder {
 public:
  // Part or material of the triangles that follow; a name that was used before is continued.
  void begin_part(const std::string& name);
  void begin_material(const std::string& name);

  std::uint32_t vertex(const Vec3& position);

  // Vertices counter-clockwise seen from outside.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  // With the surface's normals at its corners, of any length; one that is not finite or zero is none.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const std::array<Vec3, 3>& normals);
  // Two triangles a b c, a c d.
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

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

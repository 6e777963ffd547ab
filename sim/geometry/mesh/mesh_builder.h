// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Builds a mesh part by part; the output of every generator and reader.

#include <array>
#include <string>
#include <unordered_map>

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

}  // namespace seaglint

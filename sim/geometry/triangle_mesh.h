// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The project's own indexed triangle mesh. It holds any triangle soup, non-manifold ones too; topology is asked of it, never demanded.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/core/linear.h"

namespace seaglint {

struct Material {
  std::string name = "pec";  // perfect electric conductor, the only kind the solver knows so far
};

// Lengths in metres, body frame (CONVENTIONS.md): x forward, y to port, z up. Triangles are counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint16_t> triangle_part;      // index into part_names, one per triangle
  std::vector<std::uint16_t> triangle_material;  // index into materials, one per triangle
  std::vector<std::string> part_names;
  std::vector<Material> materials;

  // Appends a mesh as it is (its parts and materials are matched by name).
  void append(const TriangleMesh& other);
};

struct Bounds {
  Vec3 lower = Vec3::Zero();
  Vec3 upper = Vec3::Zero();
};
Bounds bounds(const TriangleMesh& mesh);

// The mesh moved by p -> R p + t.
TriangleMesh transformed(const TriangleMesh& mesh, const Mat3& rotation, const Vec3& translation);

}  // namespace seaglint

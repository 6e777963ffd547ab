// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Other meshes of the same surface, with those of sim/geometry/mesh/mesh_builder.h.

#include "sim/geometry/mesh/mesh_builder.h"

namespace seaglint::testing_meshes {

// Every triangle with vertices of its own, as in an STL file.
inline TriangleMesh split_vertices(const TriangleMesh& mesh) {
  TriangleMesh split = mesh;
  split.vertices.clear();
  for (auto& triangle : split.triangles) {
    for (std::uint32_t& v : triangle) {
      split.vertices.push_back(mesh.vertices[v]);
      v = static_cast<std::uint32_t>(split.vertices.size() - 1);
    }
  }
  return split;
}

inline TriangleMesh scaled(TriangleMesh mesh, const Vec3& factor) {
  for (Vec3& x : mesh.vertices) x = x.cwiseProduct(factor);
  return mesh;
}

}  // namespace seaglint::testing_meshes

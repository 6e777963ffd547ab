// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A box, and other meshes of the same surface, with those of sim/geometry/mesh/triangle_mesh.h.

#include <utility>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint::testing_meshes {

// Closed, of 12 triangles that face outwards.
inline TriangleMesh box(const Vec3& lower, const Vec3& upper) {
  MeshBuilder builder;
  for (int i = 0; i < 8; ++i)
    builder.vertex({i & 1 ? upper.x() : lower.x(), i & 2 ? upper.y() : lower.y(), i & 4 ? upper.z() : lower.z()});
  builder.quad(0, 2, 3, 1), builder.quad(4, 5, 7, 6), builder.quad(0, 1, 5, 4);
  builder.quad(2, 6, 7, 3), builder.quad(0, 4, 6, 2), builder.quad(1, 3, 7, 5);
  return builder.take();
}

// Its triangles face the other side.
inline TriangleMesh turned_over(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

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

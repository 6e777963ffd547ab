// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/gltf_normals.h"

namespace seaglint {

void flatten_normals(TriangleMesh& mesh, const GltfFlatTriangles& triangles) {
  if (mesh.corner_normals.empty()) return;
  const auto flatten = [&](std::size_t t) { mesh.corner_normals[t].fill(unit_normal(area_vector(mesh, t))); };
  for (const std::size_t t : triangles.without_normals) flatten(t);
  constexpr double kRounding = 0.87 / 127;  // rad: half a step of three components
  for (const std::size_t t : triangles.byte_normals) {
    if (normal_deviation(mesh, t) <= kRounding) flatten(t);
  }
}

}  // namespace seaglint

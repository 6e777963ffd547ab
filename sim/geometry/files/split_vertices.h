// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Vertices of formats that have one normal per vertex.

#include <array>
#include <cstdint>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// One vertex for each position and normal that occur together. Welding restores the mesh.
struct SplitVertices {
  std::vector<std::uint32_t> vertex;  // of the mesh
  std::vector<Vec3> normal;           // empty for a mesh without normals
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// In order of first use; the mesh as it is where it has no normals.
SplitVertices split_by_normal(const TriangleMesh& mesh);

}  // namespace seaglint

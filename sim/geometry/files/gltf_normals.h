// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Normals of the triangles of a glTF file that have none of their own, or rounded ones.

#include <cstddef>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct GltfFlatTriangles {
  std::vector<std::size_t> without_normals, byte_normals;  // of primitives without normals, with normals of 8 bits
};

// Gives triangles of primitives without normals flat ones (glTF 2.0, section 3.7.2.1) where others of the mesh have
// theirs, and those whose normals of 8 bits do not differ from their own by more than rounding.
void flatten_normals(TriangleMesh& mesh, const GltfFlatTriangles& triangles);

}  // namespace seaglint

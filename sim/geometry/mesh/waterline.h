// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Where the water's surface cuts a body.

#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct WaterlineCut {
  TriangleMesh mesh;            // the same surface, no triangle on both sides of the water
  std::vector<bool> submerged;  // one per triangle: below the water or in its surface
};

// Cuts the mesh along the plane z = height, m. Triangles that share an edge are cut at the same points; corners within
// 1e-6 of the mesh's largest coordinate of the plane lie in it and stay where they are, so that rounding does not
// decide whether a bottom on the water is wet. Parts and materials are kept.
WaterlineCut cut_at_waterline(const TriangleMesh& mesh, double height);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Intersection of a body with the mean water surface.

#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Distance from the water surface below which a vertex of a mesh with these bounds counts as in it, m.
double waterline_margin(const Bounds& box);

struct WaterlineCut {
  TriangleMesh mesh;            // the same surface; no triangle crosses the waterline
  std::vector<bool> submerged;  // one per triangle: below or in the water surface
};

// Cuts the mesh along the plane z = height, m. Triangles that share an edge are cut at the same points. Vertices closer
// to the plane than 1e-6 of its largest height or half-length count as in the plane and are not moved, so that
// rounding does not decide whether a bottom at the waterline is submerged. Parts, materials and normals
// are kept; the normals of new vertices are interpolated.
WaterlineCut cut_at_waterline(const TriangleMesh& mesh, double height);

}  // namespace seaglint

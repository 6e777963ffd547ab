// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Planar faces of a mesh, independent of how they were triangulated.

#include <cstdint>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct PlanarFaces {
  TriangleMesh mesh;                // vertices at identical positions merged
  std::vector<std::uint32_t> face;  // planar face of every triangle, numbered in order of their first triangle
};

// The same surface with every planar face triangulated anew. A face consists of neighbouring triangles of one part and
// material within `tolerance` (m) of the plane of the largest exactly planar region among them. Vertices inside a face
// and on straight parts of its boundary, free and non-manifold edges included, are removed; the others stay where they
// are. The triangulation is the constrained Delaunay triangulation of each face; of cocircular vertices the one with
// the smallest coordinates is joined to all others. Meshes that differ in the division of their planar faces only give
// the same triangles. Triangles with corner normals off their own stay as they are.
PlanarFaces merge_planar_faces(const TriangleMesh& mesh, double tolerance);

}  // namespace seaglint

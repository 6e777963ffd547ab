// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// PLY files; used by mesh_io. OpenMesh 9 rounds their numbers to float32, so they are read here.

#include <string>
#include <string_view>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Positions and normals (nx, ny, nz) in the precision of their properties. Polygons are triangulated
// (triangulate_polygon); triangles with two equal vertices are dropped. Throws InputError with file, line or byte, and
// cause.
TriangleMesh read_ply(std::string bytes, const std::string& file);

// Binary, little-endian, positions and normals as doubles; a vertex with several normals is written once for each.
std::string ply_bytes(const TriangleMesh& mesh);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// OBJ files; used by mesh_io. OpenMesh 9 rounds their numbers to float32, so they are read here.

#include <string>
#include <string_view>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Positions and normals are the doubles that the text states; a normal that is missing or no number is none. Polygons
// are triangulated (triangulate_polygon); triangles with two equal vertices are dropped. Throws InputError with file,
// line or byte, and cause.
TriangleMesh read_obj(std::string bytes, const std::string& file);

// Positions and normals with the digits that restore the doubles, a group per run of triangles of one part.
std::string obj_bytes(const TriangleMesh& mesh);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// OBJ, STL and PLY files by OpenMesh; used by mesh_io.

#include <string>

#include "sim/geometry/files/plain_polygons.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// `ending`: .obj, .stl or .ply.
TriangleMesh read_polygons(const SanitisedPolygons& plain, const std::string& ending, const std::string& file);
std::string polygon_bytes(const TriangleMesh& mesh, const std::string& ending);

}  // namespace seaglint

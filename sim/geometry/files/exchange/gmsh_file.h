// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shells of Gmsh's .msh files; used by mesh_io.

#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Versions 2.0 to 2.2 and 4.1, text and binary of both byte orders: triangles and quadrilaterals. Parts are physical
// surfaces by their names ("physical_7" without), else elementary surfaces ("surface_7"); of several physical surfaces
// the first; a negative one turns the elements (version 4.1). Throws InputError with file and line or byte; also for
// other versions.
TriangleMesh read_gmsh(std::string bytes, const std::string& file);

}  // namespace seaglint

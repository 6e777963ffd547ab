// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// STL files, binary ones by OpenMesh; used by mesh_io.

#include <cstddef>
#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Binary STL; positions are rounded to float32.
std::string stl_bytes(const TriangleMesh& mesh);

// Positions are the doubles that an ASCII file states, the float32 of a binary one; triangles with two equal vertices
// are dropped. Throws InputError with file, line or byte, and cause.
TriangleMesh read_stl(std::string bytes, const std::string& file);

}  // namespace seaglint

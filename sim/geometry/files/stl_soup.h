// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Binary STL by OpenMesh; used by stl_file and mesh_io.

#include <cstddef>
#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// `bytes`: a validated binary STL of `triangle_count` triangles. Throws InputError that names the file.
TriangleMesh read_stl_soup(const std::string& bytes, std::size_t triangle_count, const std::string& file);

// Binary STL; positions are rounded to float32.
std::string stl_bytes(const TriangleMesh& mesh);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// glTF 2.0 files by tinygltf; used by mesh_io.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Mesh of the bytes of a .glb or .gltf, distinguished by the magic word. `path` appears in errors; buffers are read
// from its folder only.
TriangleMesh read_gltf(const std::string& bytes, const std::filesystem::path& path);

// Files next to `path` that hold buffers, in the order of the buffers. Throws InputError as read_gltf().
std::vector<std::filesystem::path> gltf_buffer_files(const std::string& bytes, const std::filesystem::path& path);

}  // namespace seaglint

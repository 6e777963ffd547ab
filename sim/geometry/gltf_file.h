// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// glTF 2.0 through tinygltf; used by mesh_io.

#include <filesystem>
#include <string>

#include "sim/geometry/triangle_mesh.h"

namespace seaglint {

// Bytes of a .glb or .gltf, told apart by the magic word; `path` is named in errors, and buffers are read from its
// folder and no other.
TriangleMesh read_gltf(const std::string& bytes, const std::filesystem::path& path);

// A .glb, or a .gltf with its buffer as a data URI.
std::string gltf_bytes(const TriangleMesh& mesh, bool binary);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// glTF 2.0 files by tinygltf; used by mesh_io.

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Mesh of the bytes of a .glb or .gltf, distinguished by the magic word. `path` appears in errors; buffers are read
// from its folder only.
TriangleMesh read_gltf(const std::string& bytes, const std::filesystem::path& path);

// Files next to `path` that hold buffers, in the order of the buffers. Throws InputError as read_gltf().
std::vector<std::filesystem::path> gltf_buffer_files(const std::string& bytes, const std::filesystem::path& path);

// A .glb, or a .gltf with its buffer as a data URI. material_colours: linear red, green, blue in 0..1 per material;
// empty: grey.
std::string gltf_bytes(const TriangleMesh& mesh, bool binary,
                       std::span<const std::array<double, 3>> material_colours = {});

}  // namespace seaglint

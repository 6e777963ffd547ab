// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// glTF 2.0 through tinygltf; used by mesh_io.

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Bytes of a .glb or .gltf, told apart by the magic word; `path` is named in errors, and buffers are read from its
// folder and no other.
TriangleMesh read_gltf(const std::string& bytes, const std::filesystem::path& path);

// The files beside it that hold buffers, in their order. InputError as read_gltf().
std::vector<std::filesystem::path> gltf_buffer_files(const std::string& bytes, const std::filesystem::path& path);

// A .glb, or a .gltf with its buffer as a data URI. material_colours: linear red, green, blue in 0..1 for each
// material; none: grey.
std::string gltf_bytes(const TriangleMesh& mesh, bool binary,
                       std::span<const std::array<double, 3>> material_colours = {});

}  // namespace seaglint

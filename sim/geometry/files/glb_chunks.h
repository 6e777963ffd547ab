// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Container of a .glb file: one JSON chunk and at most one binary chunk (glTF 2.0, section 4.4); the JSON itself.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace seaglint {

struct GlbChunks {
  std::string_view json;
  std::string_view binary;  // empty: no binary chunk
};

bool is_glb(std::string_view bytes);

// Chunks of a .glb; any other text is one JSON chunk. Throws InputError for a truncated container or a version other
// than 2.
GlbChunks glb_chunks(std::string_view bytes, const std::string& file);

// A .glb of these chunks, each padded to a multiple of 4 bytes.
std::string glb_of(std::string json, std::string_view binary);

// Throws InputError with the file's name for a text that is no JSON, is nested too deeply, has a key twice in an
// object, or more entries of nodes, meshes and accessors than a mesh of its size.
nlohmann::json parsed_gltf(std::string_view text, const std::string& file);

// Throws InputError for a required extension on which the geometry depends and which is not read. Those of materials,
// textures, lights and metadata are no part of the geometry; KHR_mesh_quantization is read.
void refuse_required_extensions(const nlohmann::json& root, const std::string& file);

}  // namespace seaglint

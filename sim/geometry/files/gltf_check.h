// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bytes of a glTF: the chunks of a .glb, and a check of the JSON and its sizes before tinygltf reads it.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

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

struct SanitisedGltf {
  std::string bytes;                  // of a .glb where the file is one, else JSON
  std::vector<std::string> findings;  // TriangleMesh::findings
};

// The file reduced to what a mesh needs: scenes, nodes, meshes with positions and indices, names of materials,
// accessors, buffer views, buffers. Types, indices, ranges and nesting are checked; images, animations, extras,
// extensions and morph targets of weight 0 are removed; data URIs (RFC 2397) lose their type and parameters. Throws
// InputError with file and cause.
SanitisedGltf sanitised_gltf(std::string_view bytes, const std::string& file);

}  // namespace seaglint

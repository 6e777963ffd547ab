// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Validation of a glTF file before tinygltf parses it.

#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

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

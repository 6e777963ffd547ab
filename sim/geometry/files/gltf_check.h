// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Validation of a glTF file before tinygltf parses it.

#include <string>
#include <string_view>

namespace seaglint {

// The file reduced to what a mesh needs: scenes, nodes, meshes with positions and indices, names of materials,
// accessors, buffer views, buffers. Types, indices, ranges and nesting are checked; images, animations, extras and
// extensions are removed. A .glb gives a .glb. Throws InputError with file and cause.
std::string sanitised_gltf(std::string_view bytes, const std::string& file);

}  // namespace seaglint

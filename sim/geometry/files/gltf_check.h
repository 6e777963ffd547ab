// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What is checked of a glTF before tinygltf sees it.

#include <string>
#include <string_view>

namespace seaglint {

// The file reduced to what a mesh needs: scenes, nodes, meshes with positions and indices, materials' names, accessors,
// views, buffers. Types, indices, ranges and nesting are checked; images, animations, extras and extensions are gone. A
// .glb gives a .glb. InputError says what is wrong.
std::string sanitised_gltf(std::string_view bytes, const std::string& file);

}  // namespace seaglint

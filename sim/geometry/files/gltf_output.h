// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bytes of glTF 2.0 files; used by mesh_io.

#include <array>
#include <span>
#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// A .glb, or a .gltf with its buffer as a data URI. material_colours: linear red, green, blue in 0..1 per material;
// empty: grey.
std::string gltf_bytes(const TriangleMesh& mesh, bool binary,
                       std::span<const std::array<double, 3>> material_colours = {});

}  // namespace seaglint

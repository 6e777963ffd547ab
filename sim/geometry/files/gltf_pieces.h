// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What glTF makes of a mesh: its axes, and a piece for each material of each part.

#include <cstdint>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// glTF 2.0, section 3.4: +Y up, +Z forward, so +X is to port. Column i is where glTF's axis i goes in the body frame.
inline const Mat3& body_from_gltf() {
  static const Mat3 R = (Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
  return R;
}

// One part of one material with its own float32 vertices in glTF's axes.
struct GltfPiece {
  std::uint16_t part = 0, material = 0;
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
};

// Ascending in part, then material.
std::vector<GltfPiece> pieces_of(const TriangleMesh& mesh);

}  // namespace seaglint

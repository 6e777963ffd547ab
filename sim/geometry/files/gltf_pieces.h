// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Conversion of a mesh to glTF: its axes, and one primitive per part and material.

#include <cstdint>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// glTF 2.0, section 3.4: +Y up, +Z forward, so +X is to port. Column i is glTF's axis i in the body frame.
inline const Mat3& body_from_gltf() {
  static constexpr Mat3 R{Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  return R;
}

// The triangles of one part and one material, with float32 vertices of their own in glTF axes, one for each position
// and normal that occur together. Normals are written where any corner of the piece has one, as the format has it for
// all vertices or none: a corner without takes that of its triangle.
struct GltfPiece {
  std::uint16_t part = 0, material = 0;
  std::vector<float> positions, normals;  // normals: empty, or one per position
  std::vector<std::uint32_t> indices;
};

// In ascending order of part, then material.
std::vector<GltfPiece> pieces_of(const TriangleMesh& mesh);

}  // namespace seaglint

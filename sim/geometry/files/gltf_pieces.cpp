// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/gltf_pieces.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace seaglint {

std::vector<GltfPiece> pieces_of(const TriangleMesh& mesh) {
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t t) { return std::pair{mesh.triangle_part[t], mesh.triangle_material[t]}; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });

  std::vector<GltfPiece> pieces;
  struct Placed {
    std::size_t pieces = 0;  // number of pieces when the vertex was last emitted
    std::uint32_t index = 0;
  };
  std::vector<Placed> placed(mesh.vertices.size());
  for (const std::size_t t : order) {
    const auto [part, material] = key(t);
    if (pieces.empty() || pieces.back().part != part || pieces.back().material != material)
      pieces.push_back({part, material, {}, {}});
    GltfPiece& piece = pieces.back();
    for (std::uint32_t v : mesh.triangles[t]) {
      if (placed[v].pieces != pieces.size()) {
        placed[v] = {pieces.size(), static_cast<std::uint32_t>(piece.positions.size() / 3)};
        const Vec3 p = body_from_gltf().transpose() * mesh.vertices[v];
        for (int i = 0; i < 3; ++i) piece.positions.push_back(static_cast<float>(p[i]) + 0.0f);
      }
      piece.indices.push_back(placed[v].index);
    }
  }
  return pieces;
}

}  // namespace seaglint

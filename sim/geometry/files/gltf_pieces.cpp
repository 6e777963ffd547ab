// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/gltf_pieces.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace seaglint {
namespace {

bool has_normal(const TriangleMesh& mesh, std::size_t t) {
  return !mesh.corner_normals.empty() &&
         std::ranges::any_of(mesh.corner_normals[t], [](const Vec3& n) { return !n.isZero(0); });
}

// The corner's normal, or that of its triangle; of a degenerate triangle some unit vector, which the format requires.
Vec3 normal_of(const TriangleMesh& mesh, std::size_t t, int corner) {
  if (!mesh.corner_normals[t][corner].isZero(0)) return mesh.corner_normals[t][corner];
  const Vec3 own = unit_normal(area_vector(mesh, t));
  return own.isZero(0) ? Vec3(Vec3::UnitZ()) : own;
}

}  // namespace

std::vector<GltfPiece> pieces_of(const TriangleMesh& mesh) {
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t t) { return std::pair{mesh.triangle_part[t], mesh.triangle_material[t]}; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });

  std::vector<GltfPiece> pieces;
  std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> placed;  // of the current piece
  const auto append = [](std::vector<float>& list, const Vec3& x) {
    const Vec3 in_gltf = body_from_gltf().transpose() * x;
    for (int i = 0; i < 3; ++i) list.push_back(static_cast<float>(in_gltf[i]) + 0.0f);
  };
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    bool has_normals = false;
    for (; end < order.size() && key(order[end]) == key(order[first]); ++end)
      has_normals = has_normals || has_normal(mesh, order[end]);
    const auto [part, material] = key(order[first]);
    GltfPiece& piece = pieces.emplace_back(GltfPiece{part, material, {}, {}, {}});
    placed.clear();
    for (; first < end; ++first) {
      const std::size_t t = order[first];
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t v = mesh.triangles[t][i];
        const Vec3 normal = has_normals ? normal_of(mesh, t, i) : Vec3::Zero();
        const auto [place, is_new] = placed.try_emplace(
            {v, static_cast<float>(normal.x()), static_cast<float>(normal.y()), static_cast<float>(normal.z())},
            static_cast<std::uint32_t>(piece.positions.size() / 3));
        if (is_new) append(piece.positions, mesh.vertices[v]);
        if (is_new && has_normals) append(piece.normals, normal);
        piece.indices.push_back(place->second);
      }
    }
  }
  return pieces;
}

}  // namespace seaglint

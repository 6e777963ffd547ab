// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/split_vertices.h"

#include <map>
#include <numeric>
#include <tuple>

namespace seaglint {

SplitVertices split_by_normal(const TriangleMesh& mesh) {
  SplitVertices split;
  if (mesh.corner_normals.empty()) {
    split.vertex.resize(mesh.vertices.size());
    std::iota(split.vertex.begin(), split.vertex.end(), 0U);
    split.triangles = mesh.triangles;
    return split;
  }
  std::map<std::tuple<std::uint32_t, double, double, double>, std::uint32_t> number;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::uint32_t, 3>& triangle = split.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[t][i];
      const Vec3& n = mesh.corner_normals[t][i];
      const auto [place, is_new] =
          number.try_emplace({v, n.x(), n.y(), n.z()}, static_cast<std::uint32_t>(split.vertex.size()));
      if (is_new) {
        split.vertex.push_back(v);
        split.normal.push_back(n);
      }
      triangle[i] = place->second;
    }
  }
  return split;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/surface/facets.h"

#include <algorithm>

#include "sim/geometry/mesh/disjoint_sets.h"
#include "sim/geometry/mesh/topology.h"

namespace seaglint {
std::vector<Facet> make_facets(const TriangleMesh& mesh, std::span<const std::uint32_t> face) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  std::vector<Facet> facets;
  std::vector<std::array<std::uint32_t, 3>> indices;
  facets.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    Facet facet;
    for (int i = 0; i < 3; ++i) facet.corner[i] = mesh.vertices[triangle[i]];
    const Vec3 across = (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]);
    const double longest =
        std::max({(facet.corner[1] - facet.corner[0]).norm(), (facet.corner[2] - facet.corner[1]).norm(),
                  (facet.corner[0] - facet.corner[2]).norm()});
    // Degenerate triangle: height below 1e-9 m.
    if (!(across.norm() > 1e-9 * longest)) continue;
    facet.normal = across.normalized();
    facet.offset = facet.normal.dot(facet.corner[0]);
    facet.longest_edge = longest;
    facet.part = mesh.triangle_part.empty() ? std::uint16_t{0} : mesh.triangle_part[t];
    facet.material = mesh.triangle_material.empty() ? std::uint16_t{0} : mesh.triangle_material[t];
    if (!mesh.corner_normals.empty()) facet.corner_normal = mesh.corner_normals[t];
    if (!face.empty()) facet.face = static_cast<std::int32_t>(face[t]);
    facets.push_back(facet);
    indices.push_back({first[triangle[0]], first[triangle[1]], first[triangle[2]]});
  }

  // Sides of one edge are linked in a ring.
  const std::vector<EdgeUse> sides = sides_by_edge(indices, mesh.vertices.size());
  DisjointSets surfaces(facets.size());
  std::vector<std::uint32_t> at_boundary;  // facets at free edges or edges where the orientation reverses
  for (std::size_t i = 0; i < sides.size();) {
    const HalfEdge& first_side = sides[i].side;
    std::size_t end = i;
    int forward = 0;
    for (; end < sides.size() && sides[end].vertices == sides[i].vertices; ++end) {
      forward += sides[end].side.forward ? 1 : -1;
      if (end > i) surfaces.unite(first_side.triangle, sides[end].side.triangle);
    }
    for (std::size_t j = i; end - i > 1 && j < end; ++j) {
      const auto& [facet, edge, is_forward] = sides[j].side;
      facets[facet].neighbour[edge] = static_cast<std::int32_t>(sides[j + 1 < end ? j + 1 : i].side.triangle);
    }
    if (forward != 0) at_boundary.push_back(first_side.triangle);
    i = end;
  }
  std::vector<char> open(facets.size(), 0);
  for (const std::uint32_t f : at_boundary) open[surfaces.find(f)] = 1;
  for (std::uint32_t f = 0; f < facets.size(); ++f) facets[f].two_sided = open[surfaces.find(f)] != 0;
  return facets;
}

int corner_at(const Facet& facet, const Vec3& position) {
  const auto found = std::ranges::find(facet.corner, position);
  return found == facet.corner.end() ? -1 : static_cast<int>(found - facet.corner.begin());
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/facets.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "sim/geometry/mesh/disjoint_sets.h"

namespace seaglint {
namespace {

// Index of the first vertex at the same position, for every vertex.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& vertices) {
  std::map<std::tuple<double, double, double>, std::uint32_t> first;
  std::vector<std::uint32_t> number(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const Vec3& x = vertices[i];
    number[i] = first.try_emplace({x.x(), x.y(), x.z()}, i).first->second;
  }
  return number;
}

}  // namespace

std::vector<Facet> make_facets(const TriangleMesh& mesh, std::span<const std::uint32_t> face) {
  const std::vector<std::uint32_t> welded = weld(mesh.vertices);
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
    indices.push_back({welded[triangle[0]], welded[triangle[1]], welded[triangle[2]]});
  }

  // Facet sides sorted by undirected edge; sides of one edge are linked in a ring.
  struct Side {
    std::uint32_t low, high, facet, edge;
    bool upward;  // runs from low to high
  };
  std::vector<Side> sides;
  sides.reserve(3 * facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t from = indices[f][e], to = indices[f][(e + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), f, e, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.facet, a.edge) < std::tie(b.low, b.high, b.facet, b.edge);
  });
  DisjointSets surfaces(facets.size());
  std::vector<std::uint32_t> at_boundary;  // facets at free edges or edges where the orientation reverses
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    int upward = sides[i].upward ? 1 : -1;
    for (; end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high; ++end) {
      upward += sides[end].upward ? 1 : -1;
      surfaces.unite(sides[i].facet, sides[end].facet);
    }
    for (std::size_t j = i; end - i > 1 && j < end; ++j) {
      facets[sides[j].facet].neighbour[sides[j].edge] = static_cast<std::int32_t>(sides[j + 1 < end ? j + 1 : i].facet);
    }
    if (upward != 0) at_boundary.push_back(sides[i].facet);
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

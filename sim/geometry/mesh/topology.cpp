// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr double kMinHeightRatio = 1e-9;  // height over longest side; float32 positions of a 100 m target resolve 1e-7

bool is_degenerate(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  if (a == b || b == c || c == a) return true;
  const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
  const double longest2 = std::max({(q - p).squaredNorm(), (r - q).squaredNorm(), (p - r).squaredNorm()});
  return !(2.0 * area_vector(mesh, triangle).norm() > kMinHeightRatio * longest2);
}

EdgeKind kind_of(const std::vector<HalfEdge>& uses, const MeshEdge& edge) {
  if (edge.use_count == 1) return EdgeKind::kBoundary;
  if (edge.use_count > 2) return EdgeKind::kNonManifold;
  return uses[edge.first_use].forward == uses[edge.first_use + 1].forward ? EdgeKind::kInconsistent
                                                                          : EdgeKind::kManifold;
}

// A part without boundary as a chain: along each edge the forward and backward traversals of its triangles cancel.
std::vector<bool> closed_parts(const TriangleMesh& mesh, const Topology& topology) {
  std::vector<bool> closed(mesh.part_names.size(), false);
  for (std::uint16_t part : mesh.triangle_part) closed[part] = true;
  std::vector<std::pair<std::uint16_t, int>> balance;
  for (const MeshEdge& edge : topology.edges) {
    balance.clear();
    for (std::uint32_t u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
      const HalfEdge& use = topology.uses[u];
      const std::uint16_t part = mesh.triangle_part[use.triangle];
      auto place = std::find_if(balance.begin(), balance.end(), [&](const auto& entry) { return entry.first == part; });
      if (place == balance.end()) place = balance.insert(place, {part, 0});
      place->second += use.forward ? 1 : -1;
    }
    for (const auto& [part, sum] : balance) {
      if (sum != 0) closed[part] = false;
    }
  }
  return closed;
}

// Angle between the normals of the two triangles of a manifold edge, positive convex, negative concave, in (-pi, pi].
double fold_angle(const TriangleMesh& mesh, const Topology& topology, std::uint32_t edge_index) {
  const MeshEdge& edge = topology.edges[edge_index];
  SEAGLINT_CHECK(edge.kind == EdgeKind::kManifold, fmt::format("edge {} has {} triangles", edge_index, edge.use_count));
  const HalfEdge& use = topology.uses[edge.first_use];
  const HalfEdge& other = topology.uses[edge.first_use + 1];

  // With t along the edge in the sense of the first triangle, its face is to the left; at a convex edge a positive
  // rotation about t turns its normal into that of the second triangle.
  const auto& corners = mesh.triangles[use.triangle];
  const Vec3 t = (mesh.vertices[corners[(use.side + 1) % 3]] - mesh.vertices[corners[use.side]]).normalized();
  const Vec3 n1 = area_vector(mesh, use.triangle).normalized();
  const Vec3 n2 = area_vector(mesh, other.triangle).normalized();
  return std::atan2(n1.cross(n2).dot(t), n1.dot(n2));
}

}  // namespace

std::vector<EdgeUse> sides_by_edge(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t])
      SEAGLINT_CHECK(v < vertex_count, fmt::format("triangle {} names vertex {}", t, v));
  }
  // Side i of triangle t has the number 3 t + i.
  const auto ends = [&](std::uint32_t side) {
    const auto& triangle = triangles[side / 3];
    return std::pair(triangle[side % 3], triangle[(side + 1) % 3]);
  };
  const IndexGroups by_lower_vertex(3 * triangles.size(), vertex_count,
                                    [&](std::uint32_t side) { return std::min(ends(side).first, ends(side).second); });
  std::vector<EdgeUse> sides;
  sides.reserve(3 * triangles.size());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> of_vertex;  // other vertex, side
  for (std::uint32_t low = 0; low < vertex_count; ++low) {
    of_vertex.clear();
    for (const std::uint32_t side : by_lower_vertex[low]) {
      const auto [from, to] = ends(side);
      if (from != to) of_vertex.push_back({std::max(from, to), side});
    }
    std::ranges::sort(of_vertex);
    for (const auto& [high, side] : of_vertex)
      sides.push_back({{low, high}, {side / 3, static_cast<std::uint8_t>(side % 3), ends(side).first == low}});
  }
  return sides;
}

std::size_t Topology::count(EdgeKind kind) const {
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [&](const MeshEdge& edge) { return edge.kind == kind; }));
}

Topology topology_of(const TriangleMesh& mesh) {
  Topology topology;
  topology.neighbours.assign(mesh.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});

  // Sides with the same two vertices are one edge.
  topology.uses.reserve(3 * mesh.triangles.size());
  topology.edges.reserve(2 * mesh.triangles.size());
  for (const auto& [vertices, side] : sides_by_edge(mesh.triangles, mesh.vertices.size())) {
    if (topology.edges.empty() || topology.edges.back().vertices != vertices)
      topology.edges.push_back({vertices, EdgeKind::kManifold, static_cast<std::uint32_t>(topology.uses.size()), 0});
    ++topology.edges.back().use_count;
    topology.uses.push_back(side);
  }

  for (MeshEdge& edge : topology.edges) {
    edge.kind = kind_of(topology.uses, edge);
    if (edge.kind != EdgeKind::kManifold) continue;
    const HalfEdge &first = topology.uses[edge.first_use], &second = topology.uses[edge.first_use + 1];
    topology.neighbours[first.triangle][first.side] = second.triangle;
    topology.neighbours[second.triangle][second.side] = first.triangle;
  }

  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_degenerate(mesh, t)) topology.degenerate.push_back(t);
  }
  topology.part_closed = closed_parts(mesh, topology);
  return topology;
}

std::vector<Wedge> wedges(const TriangleMesh& mesh, const Topology& topology, double min_angle) {
  const auto usable = [&](std::uint32_t triangle) {
    return !std::binary_search(topology.degenerate.begin(), topology.degenerate.end(), triangle);
  };
  std::vector<Wedge> found;
  for (std::uint32_t e = 0; e < topology.edges.size(); ++e) {
    const MeshEdge& edge = topology.edges[e];
    const std::uint32_t first = topology.uses[edge.first_use].triangle;
    if (edge.kind == EdgeKind::kBoundary && usable(first)) {
      found.push_back({e, {first, kNoIndex}, 2.0 * kPi});
    } else if (edge.kind == EdgeKind::kManifold) {
      const std::uint32_t second = topology.uses[edge.first_use + 1].triangle;
      if (!usable(first) || !usable(second)) continue;
      const double angle = fold_angle(mesh, topology, e);
      if (std::abs(angle) > min_angle) found.push_back({e, {first, second}, kPi + angle});
    }
  }
  return found;
}

}  // namespace seaglint

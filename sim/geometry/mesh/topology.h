// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Adjacency of the triangles of a mesh, and groups and sets of indices. Edges are found by counting uses of vertex
// pairs, so that any triangle soup is accepted: holes, edges of three and more triangles, flipped triangles and slivers
// are counted, not rejected.

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

enum class EdgeKind : std::uint8_t {
  kManifold,      // two triangles that traverse it in opposite directions
  kBoundary,      // one triangle: a hole or the free edge of a sheet
  kInconsistent,  // two triangles that traverse it in the same direction: one is flipped
  kNonManifold,   // three or more triangles
};

// Side of one triangle: the edge from its vertex `side` to vertex (side + 1) % 3.
struct HalfEdge {
  std::uint32_t triangle = 0;
  std::uint8_t side = 0;
  bool forward = true;  // runs from MeshEdge::vertices[0] to vertices[1]
};

struct EdgeUse {
  std::array<std::uint32_t, 2> vertices{};  // of the edge, ascending
  HalfEdge side;
};

// The sides of all triangles by the vertices of their edges, those of one edge by triangle. Sides whose two vertices
// coincide are left out. Throws where a triangle names a vertex beyond vertex_count.
std::vector<EdgeUse> sides_by_edge(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count);

struct MeshEdge {
  std::array<std::uint32_t, 2> vertices{};  // ascending
  EdgeKind kind = EdgeKind::kManifold;
  std::uint32_t first_use = 0;  // uses[first_use .. first_use + use_count)
  std::uint32_t use_count = 0;
};

struct Topology {
  std::vector<MeshEdge> edges;  // ascending in their vertices
  std::vector<HalfEdge> uses;
  std::vector<std::array<std::uint32_t, 3>>
      neighbours;                         // triangle across each side; kNoIndex unless the edge is manifold
  std::vector<std::uint32_t> degenerate;  // triangles of zero area, ascending
  std::vector<bool> part_closed;  // per part: its triangles traverse every edge equally often in both directions

  std::size_t count(EdgeKind kind) const;
};

// Vertices are identified by their index: weld a mesh that repeats them first. A triangle is degenerate when its height
// over its longest side is below 1e-9 of that side.
Topology topology_of(const TriangleMesh& mesh);

// Candidate diffracting edge. The exterior angle is that of the free space in front of the two faces, in radians: pi =
// flat, 3 pi/2 = the convex edge of a box, pi/2 = the inner seam of a dihedral, 2 pi = the free edge of a sheet.
struct Wedge {
  std::uint32_t edge = 0;                                      // index into Topology::edges
  std::array<std::uint32_t, 2> triangles{kNoIndex, kNoIndex};  // second: kNoIndex at a free edge
  double exterior_angle = 0;
};

// Manifold edges whose face normals differ by more than `min_angle` (radians), and free edges of sheets. Edges of
// degenerate triangles are skipped, and inconsistent and non-manifold ones, whose faces do not define the free space.
std::vector<Wedge> wedges(const TriangleMesh& mesh, const Topology& topology, double min_angle);

// Indices 0 to count - 1 in groups, ascending in each (counting sort): triangles by vertex, members of a set.
class IndexGroups {
 public:
  // group_of(i) < groups is called twice for every index.
  template <typename GroupOf>
  IndexGroups(std::size_t count, std::size_t groups, const GroupOf& group_of) : first_(groups + 1, 0), members_(count) {
    for (std::uint32_t i = 0; i < count; ++i) ++first_[group_of(i)];
    std::uint32_t end = 0;
    for (std::uint32_t& first : first_) first = end += first;
    for (auto i = static_cast<std::uint32_t>(count); i-- > 0;) members_[--first_[group_of(i)]] = i;
  }

  std::size_t size() const { return first_.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return {members_.data() + first_[group], members_.data() + first_[group + 1]};
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> members_;
};

// Disjoint sets (union-find) of indices 0 to count - 1.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  // Representative index of the set that holds i.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace seaglint

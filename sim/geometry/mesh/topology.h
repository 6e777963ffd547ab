// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which triangles meet along which edges. Built by counting uses of vertex pairs, so it answers for any soup: holes,
// edges of three and more triangles, flipped triangles and slivers are counted, not refused.

#include <array>
#include <cstdint>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

enum class EdgeKind : std::uint8_t {
  kManifold,      // two triangles that run along it in opposite directions
  kBoundary,      // one triangle: a hole or the rim of a sheet
  kInconsistent,  // two triangles that run along it in the same direction: one of them is flipped
  kNonManifold,   // three or more triangles
};

// One triangle's side: the edge from its corner `side` to corner (side + 1) % 3.
struct HalfEdge {
  std::uint32_t triangle = 0;
  std::uint8_t side = 0;
  bool forward = true;  // runs from MeshEdge::vertices[0] to vertices[1]
};

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
      triangle_edges;  // edge of each side; kNoIndex when two corners are one vertex
  std::vector<std::array<std::uint32_t, 3>>
      neighbours;                         // triangle across each side; kNoIndex unless the edge is manifold
  std::vector<std::uint32_t> degenerate;  // triangles without area, ascending
  std::vector<bool>
      part_closed;  // per part: every edge is run through as often in either direction by this part's triangles

  std::size_t count(EdgeKind kind) const;
};

// Vertices are one when their index is: weld a mesh that repeats them first. A triangle is degenerate when its height
// over its longest side is below 1e-9 of that side.
Topology topology_of(const TriangleMesh& mesh);

// An edge that may diffract. The exterior angle is that of the free space in front of the two faces, in radians: pi =
// flat, 3 pi/2 = the convex edge of a box, pi/2 = the inner seam of a dihedral, 2 pi = the rim of a sheet.
struct Wedge {
  std::uint32_t edge = 0;                                      // index into Topology::edges
  std::array<std::uint32_t, 2> triangles{kNoIndex, kNoIndex};  // the second is kNoIndex at a rim
  double exterior_angle = 0;
};

// Manifold edges that turn by more than `least_turn` (radians) and rims of sheets. Edges of degenerate triangles are
// left out, so are inconsistent and non-manifold ones, whose faces do not say where the free space is.
std::vector<Wedge> wedges(const TriangleMesh& mesh, const Topology& topology, double least_turn);

}  // namespace seaglint

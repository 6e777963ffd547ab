// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sharp edges of a target: where two facets meet at an angle, and the rims of sheets.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/diffraction/wedge_diffraction.h"
#include "sim/scattering/target/facets.h"
#include "sim/scattering/target/panels.h"

namespace seaglint {

inline constexpr int kNoEdge = -1;

struct SharpEdge {
  Vec3 a, b;                      // runs along facet[0]'s side, that is with t of its face
  std::array<int, 2> facet{};     // equal at the rim of a sheet
  WedgeFrame front_wedge;         // on the side of the normals
  WedgeFrame back_wedge;          // the other one, of an open sheet
  bool two_sided = false;         // the wave may come from either side
  double collinear_length_m = 0;  // length of the straight run of edges that it is a part of, however it was cut

  bool is_free_edge() const { return facet[0] == facet[1]; }
  double length() const { return (b - a).norm(); }
  const Vec3& along() const { return front_wedge.face[0].t; }  // unit, from a to b
};

// An edge that may diffract as the panel on one of its sides keeps it: what tells whether a wave on the panel has to do
// with the edge, side by side in memory.
struct PanelEdge {
  Vec3 normal, other_normal;  // of the facet on this side and of the one on the other
  std::int32_t edge = kNoEdge;
  bool two_sided = false;      // the wave may come from either side
  bool is_first_face = false;  // the facet is the edge's first

  // False where records_edge() is, of closed surfaces; of sheets it depends on the side that the wave comes from.
  bool may_record_edge(const Vec3& direction) const {
    const double here = -normal.dot(direction), there = -other_normal.dot(direction);
    return two_sided || (is_first_face ? here >= there : here > there);
  }
};

struct SharpEdges {
  std::vector<SharpEdge> edges;
  std::vector<std::array<int, 3>> edges_of_facet;  // edge along corner[i] -> corner[i + 1], or kNoEdge
  std::vector<PanelEdge> panel_edges;              // panel after panel, by the facets they go by
  std::vector<std::uint32_t> panel_offset;         // of each facet, and one more

  // None when the facet's panel goes by another.
  std::span<const PanelEdge> edges_of_panel(int facet) const {
    return {panel_edges.data() + panel_offset[facet], panel_offset[facet + 1] - panel_offset[facet]};
  }
};

// Edges whose faces turn by at least `least_turn` (rad), with their runs; the rims of sheets get their thickness. Edges
// of three and more facets are left out: nobody can tell their wedge.
SharpEdges find_sharp_edges(std::span<const Facet> facets, double least_turn, double sheet_thickness_m = 0);

// Fills panel_edges from of_facet, before which edges_of_panel() must not be asked. Edges that no wave is diffracted by
// are left out: corners of closed surfaces with a right angle, or any other that goes into pi.
void index_by_panel(SharpEdges& edges, std::span<const Facet> facets, const Panels& panels);

// The wedge or corner (N < 1) a wave along k_hat meets, or nothing when it comes from within or images solve the
// corner.
const WedgeFrame* illuminated_wedge(const SharpEdge& edge, const Vec3& k_hat);

// The same of a wave that lights the panel on one side of the edge (`first`: that of its first facet). Nothing where
// the sheet's lit side is not the wedge's face there: the wave was reflected by the panel beyond the edge, comes as if
// from behind it, and is a part of the corner's answer.
const WedgeFrame* wedge_on_illuminated_face(const SharpEdge& edge, bool first, const Vec3& k_hat);

// Whether that panel speaks for the edge, whose wedge the wave meets: of its two faces the one that faces the wave more
// squarely does, which wedge_on_illuminated_face() has lit; a rim has one panel.
bool records_edge(const SharpEdge& edge, const WedgeFrame& wedge, bool first, const Vec3& k_hat);

}  // namespace seaglint

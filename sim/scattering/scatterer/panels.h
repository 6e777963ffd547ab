// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Panels and sharp edges of a target: convex polygons of coplanar neighbouring facets, and the edges that diffract.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/geometry/surface/facets.h"
#include "sim/geometry/surface/smooth_surface.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"

namespace seaglint {

// Panels: convex polygons of coplanar neighbouring facets of one part and material. A flat wall is one reflector,
// independent of its triangulation. A panel is named by its first facet, the representative of its other facets.
class Panels {
 public:
  // Every facet of a curved surface is a panel of its own. The facets must outlive the panels.
  Panels(std::span<const Facet> facets, const SmoothSurface& surface);
  explicit Panels(std::span<const Facet> facets)
      : Panels(facets, SmoothSurface(facets, smooth_sides_by_angle(facets, 0), 0)) {}

  // Representative of the facet's panel.
  int representative(int facet) const { return of_[facet]; }
  bool is_representative(int facet) const { return of_[facet] == facet; }
  // Vertices of the panel with this representative, counter-clockwise about its normal; empty for any other facet.
  std::span<const Vec3> outline(int facet) const {
    if (is_single(facet)) return facets_[facet].corner;
    return {corners_.data() + first_corner_[facet], first_corner_[facet + 1] - first_corner_[facet]};
  }
  // Facets of the panel, the representative first; empty for any other facet.
  std::span<const int> members(int facet) const {
    return {members_.data() + first_member_[facet], first_member_[facet + 1] - first_member_[facet]};
  }
  // Largest distance between two vertices of the panel, m; 0 for a facet that is not a representative.
  double size(int facet) const { return size_[facet]; }
  // Area of the panel over its size, m: the width of a long one.
  double width(int facet) const { return width_[facet]; }

 private:
  bool is_single(int facet) const { return first_member_[facet + 1] - first_member_[facet] == 1; }

  std::span<const Facet> facets_;
  std::vector<int> of_;
  std::vector<Vec3> corners_;  // vertices by panel, of panels with several facets
  std::vector<int> members_;
  std::vector<std::uint32_t> first_corner_, first_member_;  // by facet, with one entry past the end
  std::vector<double> size_, width_;
};

// Sharp (diffracting) edges of a target: dihedral edges between two facets, and free edges of open sheets.

inline constexpr int kNoEdge = -1;

struct SharpEdge {
  Vec3 a, b;                      // end points, m, in the sense of facet[0]'s side, that of t of its face
  std::array<int, 2> facet{};     // adjacent facets; equal at a free edge
  WedgeFrame front_wedge;         // wedge on the side of the facet normals
  WedgeFrame back_wedge;          // wedge on the other side, of an open sheet
  bool two_sided = false;         // the wave may be incident from either side
  bool conducts = true;           // both faces are perfect conductors
  double collinear_length_m = 0;  // of the chain of collinear edges it belongs to, independent of the triangulation

  bool is_free_edge() const { return facet[0] == facet[1]; }
  double length() const { return (b - a).norm(); }
  const Vec3& along() const { return front_wedge.face[0].t; }  // unit, from a to b
};

// Edge that may diffract, seen from the panel on one of its sides: the data that decide whether a wave on that panel
// illuminates the edge, contiguous in memory.
struct PanelEdge {
  Vec3 normal, other_normal;  // normals of the facet on this side and on the other side
  std::int32_t edge = kNoEdge;
  bool two_sided = false;      // the wave may be incident from either side
  bool is_first_face = false;  // the facet on this side is the edge's facet[0]

  // Conservative form of records_edge() for a wave along `direction`: exact on closed surfaces, always true on sheets,
  // where the side of incidence decides.
  bool may_record_edge(const Vec3& direction) const {
    const double here = -normal.dot(direction), there = -other_normal.dot(direction);
    return two_sided || (is_first_face ? here >= there : here > there);
  }
};

struct SharpEdges {
  std::vector<SharpEdge> edges;
  std::vector<std::array<int, 3>> edges_of_facet;  // edge along the side corner[i] -> corner[i + 1], or kNoEdge
  std::vector<PanelEdge> panel_edges;              // by panel, in the order of first facets
  std::vector<std::uint32_t> panel_offset;         // by facet, with one entry past the end

  // Edges of the panel with this first facet; empty for any other facet. Valid after index_by_panel().
  std::span<const PanelEdge> edges_of_panel(int facet) const {
    return {panel_edges.data() + panel_offset[facet], panel_offset[facet + 1] - panel_offset[facet]};
  }
};

// Edges whose face normals differ by at least `least_turn` (rad), with their collinear lengths. Free edges of sheets,
// and edges of sheets meshed on both sides, have the thickness sheet_thickness_m. Edges shared by three or more facets
// have no defined wedge and are left out.
SharpEdges find_sharp_edges(std::span<const Facet> facets, double least_turn, double sheet_thickness_m = 0);

// Fills panel_edges and panel_offset from edges_of_facet. Edges that never diffract are left out: concave edges of
// closed surfaces whose exterior angle divides pi, such as a right angle.
void index_by_panel(SharpEdges& edges, std::span<const Facet> facets, const Panels& panels);

// Wedge that a wave along k_hat illuminates: front or back of the edge; null when the wave arrives from inside the
// conductor, or where images solve the wedge exactly (N = 1/2, 1/3, ...).
const WedgeFrame* illuminated_wedge(const SharpEdge& edge, const Vec3& k_hat);

// The same for a wave that illuminates the panel on one side of the edge (`first`: that of facet[0]). Null where the
// illuminated side of a sheet is not a face of that wedge: the wave was then reflected by the other panel of a concave
// edge between two sheets and belongs to the field of that concave edge.
const WedgeFrame* wedge_on_illuminated_face(const SharpEdge& edge, bool first, const Vec3& k_hat);

// True for the one of the two adjacent panels that records the illumination of the edge, so that it is counted once:
// the panel closer to normal incidence, which wedge_on_illuminated_face() guarantees to be illuminated. A free edge has
// one panel.
bool records_edge(const SharpEdge& edge, const WedgeFrame& wedge, bool first, const Vec3& k_hat);

}  // namespace seaglint

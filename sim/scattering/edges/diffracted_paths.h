// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rims of the mirrors that a footprint's beam has passed, and the ways over them: straight on along the beam, where a
// rim casts its shadow line on the footprint's facet, and from the rim's point by the mirrors after it to the receiver,
// as the field that the rim diffracts goes.

#include <array>
#include <span>
#include <vector>

#include "sim/scattering/surfaces/footprint.h"
#include "sim/scattering/target/panels.h"
#include "sim/scattering/target/sharp_edges.h"

namespace seaglint {

// What a beam passes: one of its mirrors, or the facet at its end.
struct PathPanel {
  int facet = -1;  // its panel goes by
  // that take its own points to where the beam meets them; of a mirror itself included
  const ImageTransform* image_transform = nullptr;
  const DepthPlane* plane = nullptr;
  Vec3 direction = Vec3::Zero();  // of the wave at it
};

// Points this near to a rim lie on it, as for edges that bound a lit polygon (single_diffraction.cpp).
inline constexpr double kOnEdgeTolerance = 1e-7;  // m

// Slopes of psi across a shadow line below which its end stays there, and from which on it moves: the ends of both ways
// go as 1 / slope, and an interval turns it by some thousandths; that they lie apart by k d slope^2 / 2 in phase is
// lost.
inline constexpr std::array<double, 2> kSlopeTaper{0.03, 0.08};

// A rim as the transmitter sees it through the mirrors before.
struct BeamEdge {
  std::size_t panel_index;
  Vec2 a, b;
  Vec2 interior_point;  // a point of its panel
  Vec2 inward;          // a metre on its face, across the rim in the body
  double depth;         // how far that reaches from the rim, m
};

// The outline of a screen's panel in the aperture.
std::vector<Vec2> projected_outline(const Panels& panels, const RadarBasis& transmit, const PathPanel& panel);

// Of all screens, of which the first lies nearest to the transmitter: the wedges that the wave meets at their panels.
std::vector<BeamEdge> beam_edges(const SharpEdges& edges, const Panels& panels, const RadarBasis& transmit,
                                 std::span<const PathPanel> panels_on_path);

// Along one side of a lit piece, t from its start and x across into the piece.
struct SideFrame {
  const MovingVertex &from, &to;
  double length;
  Vec2 along, across;

  SideFrame(const MovingVertex& start, const MovingVertex& end);
  double t(const Vec2& p) const { return along.dot(p - from.p); }
  double x(const Vec2& p) const { return across.dot(p - from.p); }
  bool lies_on(const BeamEdge& edge) const;  // the rim, or its shadow line, bounds the piece here
};

// The ways of one footprint, of which `panels_on_path` are the mirrors and, last, the facet. All arguments must outlive
// it.
class DiffractedPaths {
 public:
  DiffractedPaths(const BistaticGeometry& geometry, std::span<const PathPanel> panels_on_path,
                  const Footprint& footprint);

  const RadarBasis& aperture() const { return basis_; }  // the transmitter's
  std::span<const PathPanel> panels_on_path() const { return panels_on_path_; }
  const Footprint& footprint() const { return footprint_; }

  // Over a point of a screen's plane, given by its place in the aperture, and by the mirrors after it to the receiver.
  struct DiffractedPath {
    Vec3 transmit, receive;  // where the antennas see the point
    double psi;              // m
  };
  DiffractedPath diffracted_path(std::size_t panel_index, const Vec2& p) const;

  // Where that way meets the footprint's plane, in the aperture.
  Vec2 landing_point(std::size_t panel_index, const Vec2& p) const;

  // The way out in the plane of the wave's direction and a direction across it, unit: along the wave and across.
  Vec2 exit_in_plane(const Vec2& direction) const;

  // What share of the end that physical optics has at the rim's shadow line is the rim's own (reflected_edge.h), by the
  // slope of psi across that line; whether the rim's face sees the way.
  struct EdgeWeight {
    double weight = 0;
    bool face_visible = false;
  };
  EdgeWeight edge_weight(const BeamEdge& edge, double slope) const;

 private:
  Vec3 at(std::size_t panel_index, const Vec2& p) const {
    return p.x() * basis_.h + p.y() * basis_.v + panels_on_path_[panel_index].plane->at(p) * basis_.r;
  }

  const BistaticGeometry& geometry_;
  const RadarBasis& basis_;  // of the aperture
  std::span<const PathPanel> panels_on_path_;
  const Footprint& footprint_;
  Vec3 normal_;  // of the footprint's image, unit
  Vec3 before_;  // the way out before that facet reflects it, unfolded, unit
};

}  // namespace seaglint

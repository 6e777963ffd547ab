// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bounding edges of the reflectors on a beam's path, and two paths through each: the straight continuation along the
// beam, which gives the edge's shadow-boundary line on the footprint's panel, and the diffracted path from a point of
// the edge via the remaining reflectors to the receiver.

#include <array>
#include <span>
#include <vector>

#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/scatterer/panels.h"
#include "sim/scattering/scatterer/sharp_edges.h"

namespace seaglint {

// A panel on a beam's path: one of its reflectors, or the panel at its end.
struct PathPanel {
  int facet = -1;  // representative facet of the panel
  // maps real points of the panel to image space; for a reflector its own reflection is included
  const ImageTransform* image_transform = nullptr;
  const DepthPlane* plane = nullptr;
  Vec3 direction = Vec3::Zero();  // of the incident wave, unit
};

// A bounding edge in image space, projected on the projection plane.
struct BeamEdge {
  std::size_t panel_index;
  Vec2 a, b;
  Vec2 interior_point;  // of its panel
  Vec2 inward;          // projection of the unit vector on its face that is normal to the edge and points inwards
  double depth;         // of the panel, measured from the edge in the projection plane, m
};

// Outline of a panel on the path, in the projection plane.
std::vector<Vec2> projected_outline(const Panels& panels, const RadarBasis& transmit, const PathPanel& panel);

// Bounding edges of all panels on the path, in the order of the path: the wedges on the illuminated side of each panel,
// N > 1.
std::vector<BeamEdge> beam_edges(const SharpEdges& edges, const Panels& panels, const RadarBasis& transmit,
                                 std::span<const PathPanel> panels_on_path);

// Coordinates along one side of an illuminated polygon: t from its start along it, x normal to it and positive inside.
struct SideFrame {
  const MovingVertex &from, &to;
  double length;
  Vec2 along, across;

  SideFrame(const MovingVertex& start, const MovingVertex& end);
  double t(const Vec2& p) const { return along.dot(p - from.p); }
  double x(const Vec2& p) const { return across.dot(p - from.p); }
  bool lies_on(const BeamEdge& edge) const;  // the edge, or its shadow-boundary line, bounds the polygon here
};

// Diffracted paths of one footprint. `panels_on_path`: its reflectors and, last, its panel. All arguments must outlive
// the object.
class DiffractedPaths {
 public:
  DiffractedPaths(const BistaticGeometry& geometry, std::span<const PathPanel> panels_on_path,
                  const Footprint& footprint);

  const RadarBasis& aperture() const { return basis_; }  // projection plane
  std::span<const PathPanel> panels_on_path() const { return panels_on_path_; }
  const Footprint& footprint() const { return footprint_; }

  // Path over a point of the panel's plane (p in the projection plane) and via the remaining reflectors to the
  // receiver.
  struct DiffractedPath {
    Vec3 transmit, receive;  // the point in the transmitter's image space, and in that of the receiver
    double psi;              // m
  };
  DiffractedPath diffracted_path(std::size_t panel_index, const Vec2& p) const;

  // Intersection of the diffracted path with the footprint's plane, in the projection plane.
  Vec2 landing_point(std::size_t panel_index, const Vec2& p) const;

  // Exit direction in the plane of the incident wave and a transverse direction (unit): components along the wave and
  // transverse, normalised.
  Vec2 exit_in_plane(const Vec2& direction) const;

  // Weight 0..1 with which the end-point contribution at the edge's shadow-boundary line is moved to the edge
  // (reflected_edge.h), for the slope of psi across that line; and whether the edge's face is visible along the path.
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
  const RadarBasis& basis_;  // projection plane
  std::span<const PathPanel> panels_on_path_;
  const Footprint& footprint_;
  Vec3 normal_;  // of the footprint's image, unit
  Vec3 before_;  // exit direction before the last panel reflects it, in image space, unit
};

}  // namespace seaglint

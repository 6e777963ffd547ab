// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bounding edges of the reflectors on a beam's path, and two paths through each: the straight continuation along the
// beam, which gives the edge's shadow-boundary line on the footprint's panel, and the diffracted path from a point of
// the edge via the remaining reflectors to the receiver.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/scatterer/panels.h"
#include "sim/scattering/tracing/interaction.h"

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
  // (edge_diffraction.h), for the slope of psi across that line; and whether the edge's face is visible along the path.
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

// Boundary terms of reflected beams: corrections to the sharp shadow boundary that physical optics (PO) gives a beam on
// the last panel, either at the shadow-boundary line of a bounding edge of a reflector or at an edge of the last panel.
//
// Let E(x) be the field of the half-plane formed by the first edge (1 in the lit region x < 0, 0 in the shadow), the
// last panel be illuminated up to its own edge at x = w, psi have the slope `slope` towards the shadow, and d be the
// distance between the edges. The integral over the panel is then, by parts (paraxial half-plane, M. Born and E. Wolf,
// Principles of Optics, section 8.7),
//
//     integral of E(x) e^{jk slope x} dx up to w
//         =  [ e^{jk slope^2 d / 2} (1 - E(w')) + e^{jk slope w} E(w) ] / (jk slope),   w' = w - slope d
//
// The first end-point contribution belongs to the first edge and has the phase of its diffracted path, as long as that
// path meets the panel inside the second edge (w' > 0); the second one belongs to the second edge, weighted by the
// field there. Two corrections follow:
//
// * The end-point contribution at a shadow-boundary line is subtracted there and added at the edge that casts the line,
//   with the phase of the diffracted path, unless the second edge obstructs that path. Both have the amplitude of the
//   last panel, so that their difference stays finite at the reflection shadow boundary, where each of them is
//   infinite. The rest of the exact edge field is computed in edge_diffraction.h.
// * Two edges close to each other along the transmit or the receive path are coupled (double knife-edge diffraction):
//   with u, v = (k / 2d)^(1/2) (w, w') and F(x) the transition function (amplitude_laws.h), the term is
//
//     (j / slope) e^{-j pi/4} / (2 sqrt(pi)) (F(u^2) / u - F(v^2) / v)
//
//   an effective width times k (dimensionless), with the phase of the path over both edges. In the forward direction,
//   where slope -> 0 and u = v, it is sqrt(k d / 2 pi) e^{-j pi/4} (1 - F(u^2)), the loss of the beam at the second
//   edge (G. Millington, R. Hewitt and F. S. Immirzi, Proc. IEE 109C (1962) 419-429). k d, u and v are computed from
//   the path lengths themselves, u^2 = k (sqrt(d^2 + w^2) - d).

// Boundary terms of the footprints that one receiver sees; none when edge diffraction is off in the settings. Appends
// to `out`, which must outlive the object, as must the scene with the receiver.
class FootprintBoundary {
 public:
  FootprintBoundary(const TracingContext& scene, const Receiver& receiver, std::vector<Contribution>& out)
      : scene_(scene), geometry_(receiver.geometry), out_(out) {}

  // Once per beam and panel, with its contribution but for the polygon.
  void start(const Interaction& interaction, const Contribution& contribution);
  // Appends the boundary terms of one footprint of that beam and panel. They are tapered to zero outside the validity
  // of half-plane diffraction (README.md, "Shadow boundaries of reflected beams"): where the path from edge to edge
  // leaves the beam, where the edges cross, on panels narrower than the transition region, and as
  // reflected_edge_weight().
  void append_terms(const Contribution& contribution);

 private:
  const TracingContext& scene_;
  const BistaticGeometry& geometry_;
  std::vector<Contribution>& out_;
  // Reflectors of the path and, last, the panel; none where there are no boundary terms.
  std::vector<PathPanel> panels_on_path_;
  std::optional<std::vector<BeamEdge>> edges_on_path_;  // computed for the first footprint that needs them
  std::vector<Vec2> outline_;                           // of the last panel, in the projection plane
};

// Upper bound of the amplitude of a boundary term over wavenumbers from `lowest` to `highest`, m; 0 where its taper is
// zero at all of them.
double boundary_term_bound(const Contribution& contribution, double lowest, double highest);

}  // namespace seaglint

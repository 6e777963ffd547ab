// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hidden-surface removal by polygons: the part of every panel that the radar, or a beam, sees, in the projection plane.
// A panel is named by its first facet.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sim/geometry/surface/facets.h"
#include "sim/scattering/geometry/image_transform.h"
#include "sim/scattering/geometry/look_basis.h"
#include "sim/scattering/geometry/moving_polygon.h"
#include "sim/scattering/scatterer/panel_bvh.h"
#include "sim/scattering/tracing/tracing_settings.h"

namespace seaglint {

// Panel in image space, projected along the unfolded ray.
struct ProjectedPanel {
  int facet = -1;
  DepthPlane plane;
  MovingPolygon polygon;  // outline in the projection plane, counter-clockwise, m
};

// Projects a panel; false when it is edge-on or its projection is smaller than min_area, m^2.
bool project_panel(ProjectedPanel& projection, const BvhPanel& panel, const ImageTransform& image_transform,
                   const RadarBasis& basis, double min_area);

// Bounding box of coplanar polygons in the projection plane, and the range of their heights towards the radar: nearest
// >= farthest, m.
struct Extent {
  Box box;
  double nearest = 0, farthest = 0;
};
Extent extent_of(std::span<const MovingPolygon> polygons, const DepthPlane& plane);  // at least one polygon

// Extent that occludes nothing and is occluded by nothing.
inline Extent empty_extent() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{}, -kInfinity, kInfinity};
}

// Conservative test: false when nothing within `front` can occlude anything within `behind`.
inline bool may_occlude(const Extent& behind, const Extent& front) {
  return front.nearest >= behind.farthest - kCoincident && overlap(front.box, behind.box);
}

// Height of plane b over plane a, m: positive where b is nearer to the radar.
MovingLine depth_difference(const DepthPlane& a, const DepthPlane& b);

// Part of b that is nearer to the radar than plane a. Of coplanar facets the one with the lower number is in front.
MovingPolygon nearer_part(const ProjectedPanel& b, const ProjectedPanel& a);

// Subtracts from the polygons of `behind` every part of `front` that is nearer to the radar; true when any changed. The
// extents are those of the polygons and of that part of the front panel that may occlude them; polygons below min_area
// (m^2) are dropped.
bool occlude(const ProjectedPanel& behind, const Extent& behind_extent, const ProjectedPanel& front,
             const Extent& front_extent, double min_area, PolygonSet& pieces);

// Directly visible part of every panel from one look direction, as disjoint convex polygons; exact for flat facets.
class VisibleSurface {
 public:
  // min_area: of the smallest polygons kept, m^2; panels within 0.01 rad of edge-on keep polygons of that area on the
  // panel itself. The facets must outlive the surface.
  VisibleSurface(std::span<const Facet> facets, const Panels& panels, const PanelBvh& tree, const RadarBasis& basis,
                 const SmallestAreas& min_area, int threads);

  // Visible polygons of the panel with this first facet in the radar's projection plane. Empty for a panel that is
  // hidden or faces away (open sheets are visible from either side), and for facets that are not the first of their
  // panel.
  std::span<const MovingPolygon> pieces(int facet) const;

  // Directly visible parts of the illuminated polygons of a panel, given after the reflections of a beam in the
  // projection plane of `transmit`; appended to `visible` as convex polygons in that plane.
  void visible_after_reflections(int facet, const ImageTransform& image_transform,
                                 std::span<const MovingPolygon> illuminated, const RadarBasis& transmit,
                                 std::vector<MovingPolygon>& visible) const;

  // The same via a reflector: parts that the radar sees reflected in the panel with first facet `reflector`, in the
  // plane of their image in it. image_transform = M R, first R, the reflection in that panel, then M, those of the
  // beam. Occlusion between the two panels is neglected.
  void visible_via_reflector(int reflector, int facet, const ImageTransform& image_transform,
                             std::span<const MovingPolygon> illuminated, const RadarBasis& transmit,
                             std::vector<MovingPolygon>& visible) const;

 private:
  // Polygons in the radar's projection plane with their bounding boxes.
  struct VisiblePieces {
    std::span<const MovingPolygon> pieces;
    const Box* boxes = nullptr;
  };
  VisiblePieces window(int facet) const;
  // Intersects the illuminated polygons of a panel with the visible polygons `window`; intersections below min_area
  // (m^2) are left out.
  static void clip_to_visible(const VisiblePieces& window, double min_area, const PanelMap& map,
                              std::span<const MovingPolygon> illuminated, std::vector<MovingPolygon>& visible);

  std::span<const Facet> facets_;
  RadarBasis basis_;
  SmallestAreas min_area_;
  // Panels that face the radar, and the visible polygons of those that are partly hidden, stored by chunks of panels.
  std::vector<ProjectedPanel> images_;
  std::vector<Extent> extents_;         // of the projections
  std::vector<std::int32_t> image_of_;  // index into images_ by facet; -1: faces away, or not the first of its panel
  struct Visibility {
    bool whole = true;
    std::uint32_t first = 0, count = 0;  // range of its polygons in its chunk
  };
  std::vector<Visibility> seen_;  // by projection
  std::vector<std::vector<MovingPolygon>> pieces_;
  std::vector<std::vector<Box>> boxes_;  // of those polygons
};

}  // namespace seaglint

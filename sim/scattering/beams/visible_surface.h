// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hidden surfaces as polygons of the aperture plane: which part of each panel does the radar, or a beam, see? Panels go
// by their first facet.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sim/scattering/beams/image_transform.h"
#include "sim/scattering/beams/polygon_set.h"
#include "sim/scattering/target/facets.h"
#include "sim/scattering/target/panel_bvh.h"

namespace seaglint {

// Facets nearer to each other than this are one surface: 1e-5 of a 10 mm wavelength.
inline constexpr double kCoincident = 1e-7;  // m

// Cosine below which a panel is edge-on and has no image.
inline constexpr double kEdgeOnPanel = 1e-7;

// A panel's image through the mirrors of a beam, projected along the unfolded ray.
struct ProjectedPanel {
  int facet = -1;
  DepthPlane plane;
  MovingPolygon polygon;  // of the projected panel
};

// False when the panel is edge-on to the ray or its image is smaller than min_area.
bool project_panel(ProjectedPanel& projection, const BvhPanel& panel, const ImageTransform& image_transform,
                   const RadarBasis& basis, double min_area);

// Where polygons of one plane lie: their box in the aperture, and the heights of their corners towards the radar, m.
struct Extent {
  Box box;
  double nearest = 0, farthest = 0;
};
Extent extent_of(std::span<const MovingPolygon> polygons, const DepthPlane& plane);  // of one polygon or more

// An extent that hides nothing and is hidden by nothing.
inline Extent empty_extent() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{}, -kInfinity, kInfinity};
}

// False when nothing within one extent hides anything within the other, as for nearly all pairs.
inline bool may_occlude(const Extent& behind, const Extent& front) {
  return front.nearest >= behind.farthest - kCoincident && overlap(front.box, behind.box);
}

// Height of plane b above plane a as a moving line: positive where b is nearer to the radar along the unfolded ray.
MovingLine depth_difference(const DepthPlane& a, const DepthPlane& b);

// The part of b that lies nearer to the radar than plane a. Facets that coincide are ordered by number, the lower one
// in front.
MovingPolygon nearer_part(const ProjectedPanel& b, const ProjectedPanel& a);

// Takes every part of the image `front` out of the pieces of `behind` that lies nearer to the radar. The extents are
// those of the pieces and of all of the front that may lie before them. True when any was cut.
bool occlude(const ProjectedPanel& behind, const Extent& behind_extent, const ProjectedPanel& front,
             const Extent& front_extent, double min_area, PolygonSet& pieces);

// What the radar sees of every facet: convex pieces without overlap, exact for the flat facets given.
class VisibleSurface {
 public:
  VisibleSurface(std::span<const Facet> facets, const Panels& panels, const PanelBvh& tree, const RadarBasis& basis,
                 double min_area, int threads);

  // Pieces of the panel that goes by this facet in the radar's aperture; empty when it is hidden or faces away (an open
  // sheet shows either side) and for facets whose panel goes by another.
  std::span<const MovingPolygon> pieces(int facet) const;

  // What the radar sees directly of the parts of a panel that a beam lights: `lit` are the parts' images through the
  // beam's mirrors, in the aperture of `transmit`. Appends convex pieces there.
  void visible_after_reflections(int facet, const ImageTransform& image_transform,
                                 std::span<const MovingPolygon> illuminated, const RadarBasis& transmit,
                                 std::vector<MovingPolygon>& visible) const;

  // The same of what it sees by a mirror, the panel that goes by facet `mirror`, in the plane of that one: `mirrors`
  // are then the beam's and, before them, this one. What stands between the two panels is not looked at.
  void visible_via_reflector(int mirror, int facet, const ImageTransform& image_transform,
                             std::span<const MovingPolygon> illuminated, const RadarBasis& transmit,
                             std::vector<MovingPolygon>& visible) const;

 private:
  // Pieces of the radar's aperture with their boxes.
  struct VisiblePieces {
    std::span<const MovingPolygon> pieces;
    const Box* boxes = nullptr;
  };
  VisiblePieces window(int facet) const;
  // What of `lit`, parts of a plane that the radar sees as `own`, shows in the window.
  void clip_to_visible(const VisiblePieces& window, const Vec3& normal, const DepthPlane& own,
                       const ImageTransform& image_transform, std::span<const MovingPolygon> illuminated,
                       const RadarBasis& transmit, std::vector<MovingPolygon>& visible) const;

  std::span<const Facet> facets_;
  RadarBasis basis_;
  double min_area_;
  // Panels that face the radar, and the pieces of those that something hides a part of, chunk by chunk of images. Most
  // are whole.
  std::vector<ProjectedPanel> images_;
  std::vector<Extent> extents_;         // of the images
  std::vector<std::int32_t> image_of_;  // of each facet; -1: it faces away or its panel goes by another
  struct Visibility {
    bool whole = true;
    std::uint32_t first = 0, count = 0;  // of its pieces in those of its chunk
  };
  std::vector<Visibility> seen_;  // of each image
  std::vector<std::vector<MovingPolygon>> pieces_;
  std::vector<std::vector<Box>> boxes_;  // of the pieces
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Panels: convex polygons of coplanar neighbouring facets of one part and material. A flat wall is one reflector,
// independent of its triangulation. A panel is named by its first facet, the representative of its other facets.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/facets.h"
#include "sim/scattering/scatterer/smooth_surface.h"

namespace seaglint {

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

}  // namespace seaglint

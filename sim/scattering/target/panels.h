// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Panels: neighbouring facets of one plane, part and material that together are one convex polygon. A beam that meets a
// flat wall meets one mirror, however the wall was cut into triangles. A panel goes by the number of its first facet;
// its other facets stand back behind that one.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/target/facets.h"
#include "sim/scattering/target/smooth_surface.h"

namespace seaglint {

class Panels {
 public:
  // A facet of a curved surface is a panel by itself.
  Panels(std::span<const Facet> facets, const SmoothSurface& surface);
  explicit Panels(std::span<const Facet> facets) : Panels(facets, SmoothSurface(facets, 0, 0)) {}

  // The facet that the panel of this facet goes by.
  int representative(int facet) const { return of_[facet]; }
  bool is_representative(int facet) const { return of_[facet] == facet; }
  // Corners of the panel that goes by this facet, counter-clockwise seen against its normal; none when it goes by
  // another.
  std::span<const Vec3> outline(int facet) const {
    if (is_single(facet)) return facets_[facet].corner;
    return {corners_.data() + first_corner_[facet], first_corner_[facet + 1] - first_corner_[facet]};
  }
  // Its facets, itself the first; none when it goes by another.
  std::span<const int> members(int facet) const {
    return {members_.data() + first_member_[facet], first_member_[facet + 1] - first_member_[facet]};
  }
  // Longest distance of two corners of its panel, m; 0 when it goes by another.
  double size(int facet) const { return size_[facet]; }

 private:
  bool is_single(int facet) const { return first_member_[facet + 1] - first_member_[facet] == 1; }

  std::span<const Facet> facets_;
  std::vector<int> of_;
  std::vector<Vec3> corners_;  // panel by panel, of those with several facets
  std::vector<int> members_;
  std::vector<std::uint32_t> first_corner_, first_member_;  // of each facet, and one more
  std::vector<double> size_;
};

}  // namespace seaglint

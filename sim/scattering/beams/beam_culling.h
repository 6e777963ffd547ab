// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Conservative test of whether a panel overlaps the prism that a beam segment sweeps, made before any polygon is
// clipped.

#include <limits>
#include <span>

#include "sim/scattering/beams/beam_segment.h"
#include "sim/scattering/target/panel_bvh.h"

namespace seaglint {

// Smallest prism around a beam cross-section, given as one or more convex pieces in the projection plane (`basis`), on
// the side of the last reflector that the segment leaves.
Prism bounding_prism(std::span<const MovingPolygon> window, const BeamSegment& segment, const RadarBasis& basis,
                     std::span<const Facet> facets);

// Result of the test for one panel.
struct PrismOverlap {
  bool possible = false;  // false: the panel faces away, lies behind the last reflector or beside the cross-section
  // Position along the prism, along . x in m, beyond which nothing is illuminated because the panel covers the whole
  // prism; infinite where it does not.
  double full_cover_distance = std::numeric_limits<double>::infinity();
};
PrismOverlap test_overlap(const BeamSegment& segment, const Prism& prism, const BvhPanel& panel);

}  // namespace seaglint

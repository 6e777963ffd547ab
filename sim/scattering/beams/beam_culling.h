// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What every panel that a leg of a beam may meet is asked, before any polygon is cut.

#include <limits>
#include <span>

#include "sim/scattering/beams/beam_segment.h"
#include "sim/scattering/target/panel_bvh.h"

namespace seaglint {

// Around the convex pieces of the aperture that a leg comes through, one or more, on the side of the mirror that the
// leg leaves; `basis` is that of the aperture.
Prism bounding_prism(std::span<const MovingPolygon> window, const BeamSegment& segment, const RadarBasis& basis,
                     std::span<const Facet> facets);

// How a panel whose box meets a leg's prism stands to the prism itself.
struct PrismOverlap {
  bool possible = false;  // they may meet; false for most: they face away, lie behind the mirror or beside the window
  // Where along the prism nothing more can be lit, m, since the panel covers all of it.
  double full_cover_distance = std::numeric_limits<double>::infinity();
};
PrismOverlap test_overlap(const BeamSegment& segment, const Prism& prism, const BvhPanel& panel);

}  // namespace seaglint

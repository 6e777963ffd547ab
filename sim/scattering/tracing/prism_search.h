// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Panels in the prism that a beam sweeps, found in the bounding-volume hierarchy, and the directly visible surface of
// every receiver.

#include <limits>
#include <span>

#include "sim/scattering/tracing/interaction.h"
#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// Every receiver of the scene must have its visible surface.
class PrismSearch : public PanelSearch {
 public:
  explicit PrismSearch(const TracingContext& scene) : scene_(scene) {}

  void find(const BeamSegment& segment, const PolygonSet& cross_section, std::vector<FoundPanel>& found) const override;
  void find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                    std::vector<MovingPolygon>& visible) const override;
  bool may_be_seen(int facet) const override;

 private:
  const TracingContext& scene_;
};

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

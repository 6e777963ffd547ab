// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Beam tracing: beams are followed from reflector to reflector, and every interaction is passed to a visitor (P. S.
// Heckbert and P. Hanrahan, Proc. SIGGRAPH 1984, 119-127). The panels in the path of a beam are those in the prism that
// it sweeps.

#include <functional>
#include <limits>
#include <span>

#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// Panels in the prism that a beam sweeps, found in the bounding-volume hierarchy, and the directly visible surface of
// every receiver.
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
PrismOverlap prism_overlap(const BeamSegment& segment, const Prism& prism, const BvhPanel& panel);

// Traces all beams whose first reflector is the panel of one of these facets (its first facet) and returns the number
// of segments behind it. Calls after_each() when the beams
// of one facet are complete.
std::size_t trace_beams(
    const TracingContext& scene, const PanelSearch& search, std::span<const int> facets, InteractionVisitor& visitor,
    const std::function<void()>& after_each = [] {});

// Traces the transmitted wave within a window of the projection plane and all that it illuminates; returns the number
// of segments. `path`: of the transmitted wave, as FoundPanel::path.
std::size_t trace_window(const TracingContext& scene, const PanelSearch& search, const PolygonSet& window, int path,
                         InteractionVisitor& visitor);

}  // namespace seaglint

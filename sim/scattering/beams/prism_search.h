// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Panels in the prism that a beam sweeps, found in the bounding-volume hierarchy, and the directly visible surface of
// every receiver.

#include "sim/scattering/beams/panel_search.h"
#include "sim/scattering/beams/tracing_context.h"

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

}  // namespace seaglint

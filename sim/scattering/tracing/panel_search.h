// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Search of the panels that a segment may illuminate, and of what obstructs their direct path to a receiver: with the
// prism of a beam (prism_search.h) or with rays (../rays).

#include <cstdint>
#include <vector>

#include "sim/scattering/scatterer/panel_bvh.h"
#include "sim/scattering/tracing/beam_segment.h"

namespace seaglint {

// A panel in the way of a segment. `path`: number by which the search knows the sequence of reflectors up to this
// panel; -1: none.
struct FoundPanel {
  const BvhPanel* panel = nullptr;
  std::int32_t path = -1;
};

class PanelSearch {
 public:
  virtual ~PanelSearch() = default;

  // Appends the panels that a segment with this cross-section may illuminate, and those that obstruct them; further
  // panels do no harm. Never the panel that the segment leaves.
  virtual void find(const BeamSegment& segment, const PolygonSet& cross_section,
                    std::vector<FoundPanel>& found) const = 0;

  // Appends the convex parts of the candidate's illuminated polygons that have an unobstructed direct path to the
  // receiver, in the projection plane of the transmitter.
  virtual void find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                            std::vector<MovingPolygon>& visible) const = 0;

  // False only where no receiver sees any part of the panel with this first facet directly.
  virtual bool may_be_seen(int facet) const = 0;
};

}  // namespace seaglint

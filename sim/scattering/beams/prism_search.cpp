// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/prism_search.h"

#include <algorithm>
#include <limits>

#include "sim/scattering/beams/beam_culling.h"

namespace seaglint {

void PrismSearch::find(const BeamSegment& segment, const PolygonSet& cross_section,
                       std::vector<FoundPanel>& found) const {
  const Prism prism = bounding_prism(cross_section.polygons(), segment, scene_.transmit, scene_.scatterer.facets());
  double covered = std::numeric_limits<double>::infinity();
  scene_.scatterer.tree().traverse(prism, [&](const BvhPanel& panel) {
    if (panel.facet == segment.source_facet) return covered;
    const PrismOverlap met = test_overlap(segment, prism, panel);
    if (met.possible) found.push_back({&panel});
    return covered = std::min(covered, met.full_cover_distance);
  });
}

void PrismSearch::find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                               std::vector<MovingPolygon>& visible) const {
  scene_.receivers[receiver].visible_to_receiver->visible_after_reflections(
      candidate.projection.facet, segment.image_transform, candidate.illuminated.polygons(), scene_.transmit, visible);
}

bool PrismSearch::may_be_seen(int facet) const {
  return std::ranges::any_of(
      scene_.receivers, [&](const Receiver& receiver) { return !receiver.visible_to_receiver->pieces(facet).empty(); });
}

}  // namespace seaglint

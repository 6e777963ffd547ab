// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/beam_history.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

BeamHistory beam_history(const BeamSegment& segment, const CandidatePanel& candidate, const Scatterer& scatterer) {
  if (!segment.previous) return {};
  const std::span<const Facet> facets = scatterer.facets();
  const int panel = candidate.projection.facet;
  // In image space a path is one straight line along the transmit direction.
  const Vec2 ray = centroid(candidate.illuminated.polygons().front());
  const double end = candidate.projection.plane.at(ray);
  double squared = 0, longest = 0;
  bool one_part = true;
  for (const BeamSegment* behind = &segment; behind->previous; behind = behind->previous) {
    const int reflector = behind->source_facet;
    const double length = behind->source_plane.at(ray) - end;
    longest = std::max(longest, length);
    squared += std::pow(2 * length / scatterer.panels().width(reflector), 2);
    one_part = one_part && facets[reflector].part == facets[panel].part;
  }
  return {static_cast<float>(std::sqrt(squared)), one_part ? static_cast<float>(longest / (segment.bounce - 1)) : 0};
}

}  // namespace seaglint

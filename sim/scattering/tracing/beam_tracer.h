// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Beam tracing: beams are followed from reflector to reflector, and the illuminated and visible polygons of every panel
// on their path are passed to a visitor (P. S. Heckbert and P. Hanrahan, Proc. SIGGRAPH 1984, 119-127).

#include <functional>
#include <span>

#include "sim/scattering/tracing/beam_segment.h"
#include "sim/scattering/tracing/panel_search.h"
#include "sim/scattering/tracing/tracing_context.h"

namespace seaglint {

// Receives the polygons that the segments of all beams illuminate.
class BeamVisitor {
 public:
  virtual ~BeamVisitor() = default;
  // True when a last segment (bounce = max_bounces) must be traced although no receiver sees any panel in its path.
  virtual bool needs_last_segment(const BeamSegment& segment) const = 0;
  // Called once for every segment and panel, with the illuminated polygons.
  virtual void illuminated(const BeamSegment& segment, const CandidatePanel& candidate) = 0;
  // Called next for every receiver: the convex parts of those polygons with an unobstructed direct path to it, in the
  // projection plane of the transmitter; may be empty.
  virtual void visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                       std::span<const MovingPolygon> pieces) = 0;
};

// Traces all beams whose first reflector is the panel of one of these facets (its first facet) and returns the number
// of segments behind it. The scene must have the surface visible to the transmitter. Calls after_each() when the beams
// of one facet are complete.
std::size_t trace_beams(
    const TracingContext& scene, const PanelSearch& search, std::span<const int> facets, BeamVisitor& visitor,
    const std::function<void()>& after_each = [] {});

// Traces the transmitted wave within a window of the projection plane and all that it illuminates; returns the number
// of segments. `path`: of the transmitted wave, as FoundPanel::path.
std::size_t trace_window(const TracingContext& scene, const PanelSearch& search, const PolygonSet& window, int path,
                         BeamVisitor& visitor);

}  // namespace seaglint

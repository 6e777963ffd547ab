// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Follows beams from mirror to mirror and hands what they light to a visitor.

#include <functional>
#include <span>

#include "sim/scattering/beams/beam_segment.h"
#include "sim/scattering/beams/tracing_context.h"

namespace seaglint {

// Receives what the legs of all beams light.
class BeamVisitor {
 public:
  virtual ~BeamVisitor() = default;
  // Whether the leg matters although no receiver sees anything of what it lights.
  virtual bool wants(const BeamSegment& segment) const = 0;
  // The candidate's lit pieces.
  virtual void lit(const BeamSegment& segment, const CandidatePanel& candidate) = 0;
  // What a receiver of the scene sees of them directly.
  virtual void seen(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                    std::span<const MovingPolygon> pieces) = 0;
};

// Follows all beams whose first mirror is the panel of one of these facets; returns the legs followed. Calls
// after_each() when the beams of one are followed.
std::size_t trace_beams(
    const TracingContext& scene, std::span<const int> facets, BeamVisitor& visitor,
    const std::function<void()>& after_each = [] {});

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a beam brings to edges: the waves that reach sharp edges of the panels it lights, and what its footprints lack
// where it ends.

#include <array>
#include <optional>
#include <vector>

#include "sim/scattering/beams/beam_segment.h"
#include "sim/scattering/beams/tracing_context.h"
#include "sim/scattering/edges/beam_boundary.h"
#include "sim/scattering/edges/edge_illumination.h"
#include "sim/scattering/edges/reflected_edge.h"
#include "sim/scattering/surfaces/beam_contributions.h"

namespace seaglint {

// Whether the leg's waves are followed to edges: with more mirrors before it an edge is not.
bool records_edges(const TracingContext& scene, const BeamSegment& segment);

// Appends the arrivals at the candidate's edges. Wedges are perfect conductors, and so is what the wave met before.
void record_edges(const TracingContext& scene, const BeamSegment& segment, const CandidatePanel& candidate,
                  std::vector<EdgeIllumination>& illuminations);

// What one receiver's footprints lack where their beams end; nothing without edges in the scene's settings. Appends to
// `out`; it and the scene with the receiver must outlive this.
class FootprintEnds : public FootprintVisitor {
 public:
  FootprintEnds(const TracingContext& scene, const Receiver& receiver, std::vector<EdgeContribution>& out);

  void start(const BeamSegment& segment, const CandidatePanel& candidate, const Footprint& footprint) override;
  void add(const Footprint& footprint) override;

 private:
  // Perfect conductors, as wedges are, and flat.
  bool has_boundary_terms(const BeamSegment& segment, const Footprint& footprint) const;

  const TracingContext& scene_;
  const BistaticGeometry& geometry_;
  std::vector<EdgeContribution>& out_;
  std::array<PathPanel, kMaxCorrectedReflections + 1>
      panels_on_path_;  // the mirrors and the panel of the footprints that are added
  std::optional<BeamBoundary> ends_;
};

}  // namespace seaglint

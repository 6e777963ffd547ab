// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Edge diffraction per beam: records the waves that illuminate sharp edges of a panel, and adds the boundary terms of
// its footprints.

#include <array>
#include <optional>
#include <vector>

#include "sim/scattering/radiation/beam_boundary.h"
#include "sim/scattering/radiation/beam_contributions.h"
#include "sim/scattering/radiation/reflected_edge.h"
#include "sim/scattering/tracing/beam_segment.h"
#include "sim/scattering/tracing/edge_illumination.h"
#include "sim/scattering/tracing/tracing_context.h"

namespace seaglint {

// True when the waves of this beam segment are recorded at edges: at most kMaxEdgeReflections reflections before the
// edge.
bool records_edges(const TracingContext& scene, const BeamSegment& segment);

// Appends the illumination of the candidate's edges. Only perfectly conducting wedges are included, and waves that met
// only perfect conductors before.
void record_edges(const TracingContext& scene, const BeamSegment& segment, const CandidatePanel& candidate,
                  std::vector<EdgeIllumination>& illuminations);

// Adds the boundary terms of the footprints that one receiver sees; none when edge diffraction is off in the settings.
// Appends to `out`, which must outlive the object, as must the scene with the receiver.
class FootprintEnds : public FootprintVisitor {
 public:
  FootprintEnds(const TracingContext& scene, const Receiver& receiver, std::vector<EdgeContribution>& out);

  void start(const BeamSegment& segment, const CandidatePanel& candidate, const Footprint& footprint) override;
  void add(const Footprint& footprint) override;

 private:
  // True for flat perfect conductors on the whole path, after one to kMaxCorrectedReflections reflections.
  bool has_boundary_terms(const BeamSegment& segment, const Footprint& footprint) const;

  const TracingContext& scene_;
  const BistaticGeometry& geometry_;
  std::vector<EdgeContribution>& out_;
  std::array<PathPanel, kMaxCorrectedReflections + 1>
      panels_on_path_;  // reflectors and the panel of the current footprints
  std::optional<BeamBoundary> ends_;
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The panels that rays found, as the search of the beam tracer.

#include "sim/scattering/beams/panel_search.h"
#include "sim/scattering/rays/ray_paths.h"

namespace seaglint {

// Scene and paths must outlive it.
class RaySearch : public PanelSearch {
 public:
  RaySearch(const TracingContext& scene, const RayPaths& paths) : scene_(scene), paths_(paths) {}

  void find(const BeamSegment& segment, const PolygonSet& cross_section, std::vector<FoundPanel>& found) const override;
  void find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                    std::vector<MovingPolygon>& visible) const override;
  bool may_be_seen(int) const override { return true; }

 private:
  const TracingContext& scene_;
  const RayPaths& paths_;
};

}  // namespace seaglint

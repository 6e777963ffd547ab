// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The panels that rays found, and their neighbours on the mesh, whose illuminated part may be too narrow for a ray, as
// the search of the beam tracer.

#include <unordered_map>

#include "sim/scattering/tracing/interaction.h"
#include "sim/scattering/tracing/ray_paths.h"

namespace seaglint {

// Scene and paths must outlive it.
class RaySearch : public PanelSearch {
 public:
  RaySearch(const TracingContext& scene, const RayPaths& paths)
      : scene_(scene), paths_(paths), found_by_(scene.scatterer.facets().size(), 0) {}

  void find(const BeamSegment& segment, const PolygonSet& cross_section, std::vector<FoundPanel>& found) const override;
  void find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                    std::vector<MovingPolygon>& visible) const override;
  bool may_be_seen(int) const override { return true; }

 private:
  const BvhPanel* panel(int facet) const;

  const TracingContext& scene_;
  const RayPaths& paths_;
  // Work memory: panels by their first facet, and the last search that found them.
  mutable std::unordered_map<int, BvhPanel> panels_;
  mutable std::vector<std::uint64_t> found_by_;
  mutable std::uint64_t searches_ = 0;
};

}  // namespace seaglint

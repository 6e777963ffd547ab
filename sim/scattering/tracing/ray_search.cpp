// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/ray_search.h"

#include <utility>

namespace seaglint {

const BvhPanel* RaySearch::panel(int facet) const {
  const auto [place, is_new] = panels_.try_emplace(facet);
  if (is_new) place->second = bvh_panel(scene_.scatterer.facets(), scene_.scatterer.panels(), facet);
  return &place->second;
}

void RaySearch::find(const BeamSegment& segment, const PolygonSet&, std::vector<FoundPanel>& found) const {
  if (segment.path < 0) return;
  const std::uint64_t search = ++searches_;
  const auto mark = [&](int facet) {
    return std::exchange(found_by_[static_cast<std::size_t>(facet)], search) != search;
  };
  if (segment.source_facet != kNoFacet) mark(segment.source_facet);
  const std::size_t first = found.size();
  for (int child = paths_.path(segment.path).first_child; child >= 0; child = paths_.path(child).next_sibling) {
    mark(paths_.path(child).facet);
    found.push_back({panel(paths_.path(child).facet), child});
  }
  const Panels& panels = scene_.scatterer.panels();
  for (std::size_t met = first, end = found.size(); met < end; ++met) {
    for (const int member : panels.members(found[met].panel->facet)) {
      for (const std::int32_t across : scene_.scatterer.facets()[member].neighbour) {
        if (across < 0) continue;
        const int neighbour = panels.representative(across);
        if (paths_.is_lit(neighbour, segment.direction) && mark(neighbour)) found.push_back({panel(neighbour), -1});
      }
    }
  }
}

void RaySearch::find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                             std::vector<MovingPolygon>& visible) const {
  const std::span<const MovingPolygon> illuminated = candidate.illuminated.polygons();
  const std::span<const Obstacle> obstacles = paths_.obstacles(candidate.path, receiver);
  if (obstacles.empty()) {
    visible.insert(visible.end(), illuminated.begin(), illuminated.end());
    return;
  }
  const Scatterer& target = scene_.scatterer;
  const RadarBasis& receive = scene_.receivers[receiver].geometry.receive;
  const Facet& facet = target.facets()[candidate.projection.facet];
  const double min_area = scene_.min_area.on(candidate.projection.facet);
  ProjectedPanel own, obstacle;
  own.facet = candidate.projection.facet;
  own.plane = depth_plane(facet.normal, facet.offset, receive);
  const PanelMap map(own.plane, receive, segment.image_transform, scene_.transmit);
  PolygonSet left;
  left.assign(illuminated);
  for (const Obstacle& found : obstacles) {
    if (found.facet == own.facet ||
        !project_panel(obstacle, bvh_panel(target.facets(), target.panels(), found.facet), {}, receive, min_area))
      continue;
    const MovingPolygon nearer = nearer_part(obstacle, own);
    if (nearer.empty()) continue;
    const MovingPolygon shadow = map.mapped(nearer);
    left.subtract_hole(shadow, box_of(shadow), min_area);
  }
  visible.insert(visible.end(), left.polygons().begin(), left.polygons().end());
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/beam_edges.h"

#include <span>

#include "sim/scattering/radiation/single_diffraction.h"

namespace seaglint {

bool records_edges(const TracingContext& scene, const BeamSegment& segment) {
  return scene.settings.edges && segment.bounce <= kMaxEdgeReflections + 1;
}

void record_edges(const TracingContext& scene, const BeamSegment& segment, const CandidatePanel& candidate,
                  std::vector<EdgeIllumination>& illuminations) {
  if (!segment.fields.empty()) return;
  const bool on_conductor = scene.surface_of(candidate.projection.facet).empty();
  const FacetWave wave{scene.transmit,
                       segment.image_transform,
                       candidate.projection.plane,
                       segment.direction,
                       segment.E_h,
                       segment.E_v,
                       segment.bounce,
                       on_conductor,
                       segment.first_reflector_normal};
  find_edge_illumination(scene.scatterer.edges(), candidate.projection.facet, wave, candidate.illuminated.polygons(),
                         illuminations);
}

FootprintEnds::FootprintEnds(const TracingContext& scene, const Receiver& receiver, std::vector<EdgeContribution>& out)
    : scene_(scene), geometry_(receiver.geometry), out_(out) {}

void FootprintEnds::start(const BeamSegment& segment, const CandidatePanel& candidate, const Footprint& footprint) {
  ends_.reset();
  if (!has_boundary_terms(segment, footprint)) return;
  auto place = static_cast<std::size_t>(segment.bounce) - 1;
  panels_on_path_[place] = {candidate.projection.facet, &segment.image_transform, &candidate.projection.plane,
                            segment.direction};
  for (const BeamSegment* after = &segment; place > 0; after = after->previous)
    panels_on_path_[--place] = {after->source_facet, &after->image_transform, &after->source_plane,
                                after->previous->direction};
  ends_.emplace(scene_.scatterer.edges(), scene_.scatterer.panels(), geometry_,
                std::span<const PathPanel>(panels_on_path_.data(), static_cast<std::size_t>(segment.bounce)));
}

void FootprintEnds::add(const Footprint& footprint) {
  if (ends_) ends_->append_boundary_terms(footprint, out_);
}

bool FootprintEnds::has_boundary_terms(const BeamSegment& segment, const Footprint& footprint) const {
  return scene_.settings.edges && segment.bounce > 1 && segment.bounce <= kMaxCorrectedReflections + 1 &&
         !segment.has_curved_reflection && !footprint.curvature && footprint.patterns.empty();
}

}  // namespace seaglint

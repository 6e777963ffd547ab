// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/beam_edges.h"

#include <span>

#include "sim/scattering/edges/single_diffraction.h"

namespace seaglint {

bool reaches_edges(const BeamScene& scene, const Leg& leg) {
  return scene.settings.edges && leg.bounce <= kMostEdgeMirrors + 1;
}

void reach_edges(const BeamScene& scene, const Leg& leg, const Candidate& candidate,
                 std::vector<EdgeArrival>& arrivals) {
  if (!leg.fields.empty() || !scene.surface_of(candidate.image.facet).empty()) return;
  const WaveOnFacet wave{scene.transmit, leg.mirrors, candidate.image.plane, leg.direction, leg.E_h,
                         leg.E_v,        leg.bounce,  leg.first_mirror};
  find_arrivals(scene.scatterer.edges(), candidate.image.facet, wave, candidate.lit.polygons(), arrivals);
}

FootprintEnds::FootprintEnds(const BeamScene& scene, const Receiver& receiver, std::vector<EdgeFootprint>& out)
    : scene_(scene), antennas_(receiver.antennas), out_(out) {}

void FootprintEnds::start(const Leg& leg, const Candidate& candidate, const Footprint& footprint) {
  ends_.reset();
  if (!has_beam_ends(leg, footprint)) return;
  auto place = static_cast<std::size_t>(leg.bounce) - 1;
  screens_[place] = {candidate.image.facet, &leg.mirrors, &candidate.image.plane, leg.direction};
  for (const Leg* after = &leg; place > 0; after = after->before)
    screens_[--place] = {after->from_facet, &after->mirrors, &after->from_plane, after->before->direction};
  ends_.emplace(scene_.scatterer.edges(), scene_.scatterer.panels(), antennas_,
                std::span<const Screen>(screens_.data(), static_cast<std::size_t>(leg.bounce)));
}

void FootprintEnds::add(const Footprint& footprint) {
  if (ends_) ends_->find(footprint, out_);
}

bool FootprintEnds::has_beam_ends(const Leg& leg, const Footprint& footprint) const {
  return scene_.settings.edges && leg.bounce > 1 && leg.bounce <= kMostMoved + 1 && !leg.bent && !footprint.curvature &&
         footprint.patterns.empty();
}

}  // namespace seaglint

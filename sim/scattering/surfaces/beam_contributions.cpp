// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/surfaces/beam_contributions.h"

#include <cmath>

#include "sim/scattering/diffraction/wedge.h"
#include "sim/scattering/material/reflection.h"

namespace seaglint {
BeamEcho::BeamEcho(const BeamScene& scene, const Receiver& receiver, std::vector<Footprint>& out,
                   FootprintVisitor* visitor)
    : scene_(scene),
      facets_(scene.scatterer.facets()),
      curving_{facets_, scene.scatterer.surface(), scene.transmit},
      panels_(scene.scatterer.panels()),
      antennas_(receiver.antennas),
      visible_(*receiver.visible),
      basis_(scene.transmit),
      longest_slip_(2 * scene.scatterer.radius()),
      out_(out),
      visitor_(visitor) {}

void BeamEcho::radiate(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> pieces) {
  const Facet& facet = facets_[candidate.image.facet];
  const Vec3 n = facing(leg, facets_[candidate.image.facet]);
  if (pieces.empty() || n.dot(antennas_.receive.r) <= kEdgeOn) return;

  Footprint footprint;
  footprint.plane = candidate.image.plane;
  footprint.mirrors = leg.mirrors;
  footprint.facet = candidate.image.facet;
  footprint.part = facet.part;
  footprint.facet_size = panels_.size(candidate.image.facet);
  footprint.bounces = static_cast<std::uint8_t>(leg.bounce);
  set_phase(footprint, leg.mirrors.L * facet.normal, antennas_);
  footprint.pattern = conductor_pattern(leg, n, std::abs(n.dot(leg.direction)), antennas_.receive);
  if (!leg.fields.empty() || !scene_.surface_of(footprint.facet).empty()) {
    footprint.patterns = patterns(leg, footprint.facet, n);
    footprint.pattern = footprint.patterns[footprint.patterns.size() / 2];
  }
  footprint.curvature = curvature_of(curving_, panels_, antennas_, leg, candidate, footprint);
  if (visitor_) visitor_->start(leg, candidate, footprint);
  const double share = leaves_grazing(leg, footprint.facet) ? share_of_way(leg, footprint.facet) : 1.0;
  // More is given with the ends of its beams; where less is left they have faded out as much (rim_share).
  if (share > 1) give_share(share, footprint);
  for (const MovingPolygon& piece : pieces) {
    footprint.polygon = piece;
    limit_slip(footprint, longest_slip_);
    if (visitor_) visitor_->add(footprint);
    if (share <= 0) continue;
    out_.push_back(footprint);
    if (share < 1) give_share(share, out_.back());
  }
}

void BeamEcho::radiate_back(const Leg& leg, const Candidate& candidate, std::span<const MovingPolygon> seen) {
  const int facet = candidate.image.facet;
  if (leg.bounce < 2 || leg.bounce >= scene_.settings.max_bounces || !leaves_grazing(leg, facet)) return;
  const double share = share_by_image(basis_.r, mirror_of(leg.first_facet), mirror_of(facet));
  if (share <= 0) return;
  const Facet& mirror = facets_[leg.first_facet];
  const Mirror by = plane_mirror(mirror.normal, mirror.offset);
  const Vec3 lit_side = facing(leg, facets_[facet]), n = by.L * lit_side;
  if (n.dot(basis_.r) <= kEdgeOn) return;
  // A perfect conductor's image has the field along it turned round.
  Leg image;
  image.direction = by.L * leg.direction;
  image.E_h = -by.L * leg.E_h;
  image.E_v = -by.L * leg.E_v;
  Footprint footprint;
  footprint.plane = candidate.image.plane;
  footprint.mirrors = leg.mirrors * by;
  footprint.facet = facet;
  footprint.part = facets_[facet].part;
  footprint.facet_size = panels_.size(facet);
  footprint.bounces = static_cast<std::uint8_t>(leg.bounce + 1);
  set_phase(footprint, leg.mirrors.L * lit_side, antennas_);
  footprint.pattern = conductor_pattern(image, n, std::abs(n.dot(image.direction)), basis_);
  give_share(share, footprint);
  // What the mirror lights at first, a receiver at the same place sees by it.
  std::vector<MovingPolygon> by_mirror;
  if (leg.bounce > 2) visible_.seen_by(leg.first_facet, facet, footprint.mirrors, seen, basis_, by_mirror);
  for (const MovingPolygon& piece :
       leg.bounce > 2 ? std::span<const MovingPolygon>(by_mirror) : candidate.lit.polygons()) {
    footprint.polygon = piece;
    limit_slip(footprint, longest_slip_);
    out_.push_back(footprint);
  }
}

std::vector<std::array<Complex, 4>> BeamEcho::patterns(const Leg& leg, int facet, const Vec3& n) const {
  const std::span<const Surface> surface = scene_.surface_of(facet);
  const auto& [r, h, v] = antennas_.receive;
  const double cosine = std::abs(n.dot(leg.direction));
  std::vector<std::array<Complex, 4>> patterns(surface.empty() ? leg.fields.size() : surface.size());
  for (std::size_t q = 0; q < patterns.size(); ++q) {
    const SurfaceFields at = surface.empty() ? SurfaceFields{} : surface[q].at(cosine);
    const double coherence = surface.empty() ? 1.0 : surface[q].coherence(cosine, n.dot(r));
    const BeamField field = field_at(leg, q);
    const CVec3 by_h = coherence * radiated_field(at, leg.direction, n, r, field.h),
                by_v = coherence * radiated_field(at, leg.direction, n, r, field.v);
    patterns[q] = {along(h, by_h), along(h, by_v), along(v, by_h), along(v, by_v)};
  }
  return patterns;
}

bool BeamEcho::leaves_grazing(const Leg& leg, int facet) const {
  return scene_.settings.edges && antennas_.monostatic && !leg.bent && !curving_.surface.curved(facet) &&
         leg.fields.empty() && scene_.surface_of(facet).empty() &&
         !scene_.settings.filter.is_cavity(facets_[facet].part);
}

GrazedMirror BeamEcho::mirror_of(int facet) const { return {facets_[facet].normal, panels_.outline(facet)}; }

double BeamEcho::share_of_way(const Leg& leg, int last) const {
  if (leg.bounce == 1) return 1;
  const GrazedMirror first = mirror_of(leg.first_facet);
  return leg.bounce > 2 ? share_of_more(basis_.r, first, mirror_of(leg.from_facet), mirror_of(last))
                        : share_of_two(basis_.r, first, mirror_of(last));
}

}  // namespace seaglint

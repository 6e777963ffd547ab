// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/beam_contributions.h"

#include <algorithm>
#include <cmath>

#include "sim/scattering/coefficients/reflection.h"
#include "sim/scattering/geometry/tolerances.h"

namespace seaglint {
namespace {

// Multiplies the pattern of a perfectly conducting footprint by a weight; the part above 1 is the transposed pattern
// (reciprocal path).
void weight_with_reciprocal(double weight, Footprint& footprint) {
  const double there = std::min(weight, 1.0), back = weight - there;
  const auto [hh, hv, vh, vv] = footprint.pattern;
  footprint.pattern = {there * hh + back * hh, there * hv + back * vh, there * vh + back * hv, there * vv + back * vv};
}

}  // namespace

BeamContributions::BeamContributions(const TracingContext& scene, const Receiver& receiver, std::vector<Footprint>& out,
                                     FootprintVisitor* visitor)
    : scene_(scene),
      facets_(scene.scatterer.facets()),
      curvature_{facets_, scene.scatterer.surface(), scene.transmit},
      panels_(scene.scatterer.panels()),
      geometry_(receiver.geometry),
      visible_(receiver.visible_to_receiver),
      basis_(scene.transmit),
      max_slide_rate_(2 * scene.scatterer.radius()),
      out_(out),
      visitor_(visitor) {}

void BeamContributions::radiate(const BeamSegment& segment, const CandidatePanel& candidate,
                                std::span<const MovingPolygon> pieces) {
  const Facet& facet = facets_[candidate.projection.facet];
  const Vec3 n = illuminated_normal(segment, facets_[candidate.projection.facet]);
  if (pieces.empty() || n.dot(geometry_.receive.r) <= kEdgeOn) return;

  Footprint footprint;
  footprint.plane = candidate.projection.plane;
  footprint.image_transform = segment.image_transform;
  footprint.facet = candidate.projection.facet;
  footprint.part = facet.part;
  footprint.panel_size = panels_.size(candidate.projection.facet);
  footprint.bounces = static_cast<std::uint8_t>(segment.bounce);
  footprint.history = beam_history(segment, candidate, scene_.scatterer);
  set_phase(footprint, segment.image_transform.L * facet.normal, geometry_);
  footprint.pattern = pec_pattern(segment, n, std::abs(n.dot(segment.direction)), geometry_.receive);
  if (!segment.fields.empty() || !scene_.surface_of(footprint.facet).empty()) {
    footprint.patterns = patterns(segment, footprint.facet, n);
    footprint.pattern = footprint.patterns[footprint.patterns.size() / 2];
  }
  footprint.curvature = make_curved_footprint(curvature_, geometry_, segment, candidate, footprint);
  if (visitor_) visitor_->start(segment, candidate, footprint);
  const double weight = uses_grazing_treatment(segment, footprint.facet) ? path_weight(segment, footprint.facet) : 1.0;
  // A weight above 1 applies to the boundary terms too; for a weight below 1 they are tapered equally
  // (reflected_edge_weight).
  if (weight > 1) weight_with_reciprocal(weight, footprint);
  for (const MovingPolygon& piece : pieces) {
    footprint.polygon = piece;
    limit_slide_rate(footprint, max_slide_rate_);
    if (visitor_) visitor_->add(footprint);
    if (weight <= 0) continue;
    out_.push_back(footprint);
    if (weight < 1) weight_with_reciprocal(weight, out_.back());
  }
}

void BeamContributions::radiate_image(const BeamSegment& segment, const CandidatePanel& candidate,
                                      std::span<const MovingPolygon> visible) {
  const int facet = candidate.projection.facet;
  if (segment.bounce < 2 || segment.bounce >= scene_.settings.max_bounces || !uses_grazing_treatment(segment, facet))
    return;
  const double weight = image_weight(basis_.r, reflector_panel(segment.first_reflector), reflector_panel(facet));
  if (weight <= 0) return;
  const Facet& reflector = facets_[segment.first_reflector];
  const ImageTransform by = plane_reflection(reflector.normal, reflector.offset);
  const Vec3 illuminated_side = illuminated_normal(segment, facets_[facet]), n = by.L * illuminated_side;
  if (n.dot(basis_.r) <= kEdgeOn) return;
  // The tangential field of the image has the opposite sign (perfect conductor).
  BeamSegment image;
  image.direction = by.L * segment.direction;
  image.E_h = -by.L * segment.E_h;
  image.E_v = -by.L * segment.E_v;
  Footprint footprint;
  footprint.plane = candidate.projection.plane;
  footprint.image_transform = segment.image_transform * by;
  footprint.facet = facet;
  footprint.part = facets_[facet].part;
  footprint.panel_size = panels_.size(facet);
  footprint.bounces = static_cast<std::uint8_t>(segment.bounce + 1);
  footprint.history = beam_history(segment, candidate, scene_.scatterer);
  set_phase(footprint, segment.image_transform.L * illuminated_side, geometry_);
  footprint.pattern = pec_pattern(image, n, std::abs(n.dot(image.direction)), basis_);
  weight_with_reciprocal(weight, footprint);
  // The part that the reflector illuminates first is the part that a receiver at the same place sees via it.
  std::vector<MovingPolygon> by_reflector;
  if (segment.bounce > 2)
    visible_->visible_via_reflector(segment.first_reflector, facet, footprint.image_transform, visible, basis_,
                                    by_reflector);
  for (const MovingPolygon& piece :
       segment.bounce > 2 ? std::span<const MovingPolygon>(by_reflector) : candidate.illuminated.polygons()) {
    footprint.polygon = piece;
    limit_slide_rate(footprint, max_slide_rate_);
    out_.push_back(footprint);
  }
}

std::vector<std::array<Complex, 4>> BeamContributions::patterns(const BeamSegment& segment, int facet,
                                                                const Vec3& n) const {
  const std::span<const MaterialSurface> surface = scene_.surface_of(facet);
  const auto& [r, h, v] = geometry_.receive;
  const double cosine = std::abs(n.dot(segment.direction));
  std::vector<std::array<Complex, 4>> patterns(surface.empty() ? segment.fields.size() : surface.size());
  for (std::size_t q = 0; q < patterns.size(); ++q) {
    const InterfaceCoefficients at = surface.empty() ? InterfaceCoefficients{} : surface[q].at(cosine);
    const double coherence = surface.empty() ? 1.0 : surface[q].roughness_factor(cosine, n.dot(r));
    const BeamField field = field_at(segment, q);
    const CVec3 by_h = coherence * radiated_field(at, segment.direction, n, r, field.h),
                by_v = coherence * radiated_field(at, segment.direction, n, r, field.v);
    patterns[q] = {component_along(h, by_h), component_along(h, by_v), component_along(v, by_h),
                   component_along(v, by_v)};
  }
  return patterns;
}

bool BeamContributions::uses_grazing_treatment(const BeamSegment& segment, int facet) const {
  return scene_.settings.edges && geometry_.monostatic && !segment.has_curved_reflection &&
         !curvature_.surface.curved(facet) && segment.fields.empty() && scene_.surface_of(facet).empty() &&
         !scene_.settings.filter.is_cavity(facets_[facet].part);
}

ReflectorPanel BeamContributions::reflector_panel(int facet) const {
  return {facets_[facet].normal, panels_.outline(facet)};
}

double BeamContributions::path_weight(const BeamSegment& segment, int last) const {
  if (segment.bounce == 1) return 1;
  const ReflectorPanel first = reflector_panel(segment.first_reflector);
  return segment.bounce > 2
             ? multiple_bounce_weight(basis_.r, first, reflector_panel(segment.source_facet), reflector_panel(last))
             : double_bounce_weight(basis_.r, first, reflector_panel(last));
}

}  // namespace seaglint

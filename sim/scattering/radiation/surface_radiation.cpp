// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/surface_radiation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {

namespace {

// Triangle around the cross-section of a beam. It depends on the beam alone: adjoining footprints of the beam are
// divided equally, and their contour terms cancel.
std::array<Vec2, 3> around_beam(const BeamSegment& segment) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const MovingPolygon& polygon : segment.cross_section->polygons()) {
    for (const MovingVertex& vertex : polygon) {
      low = low.cwiseMin(vertex.p);
      high = high.cwiseMax(vertex.p);
    }
  }
  const Vec2 size = high - low;
  return {low, Vec2(low.x() + 2 * size.x(), low.y()), Vec2(low.x(), low.y() + 2 * size.y())};
}

// Cosine of incidence at a normal of the smooth surface; kept positive beyond the shadow boundary, where the current is
// zero.
double smooth_cosine(const BeamSegment& segment, const Facet& flat, const Vec3& normal) {
  return std::max(-normal.dot(segment.direction), 0.25 * std::abs(flat.normal.dot(segment.direction)));
}

}  // namespace

Complex CurvedFootprint::divergence_factor(const Vec2& p) const {
  if (!has_bundle) return 1;
  const Mat2 spreading = rays.spreading(p);
  const double widened = spreading.determinant();
  const Complex caustics = widened < 0 ? Complex(0, 1) : spreading.trace() < 0 ? Complex(-1) : Complex(1);
  // Limited, so that the factor tends to zero at a caustic also on an oblique panel.
  constexpr double kMaxObliquity = 2;
  const double on_panel = std::abs(rays.panel_spreading(p).determinant()), across = std::abs(widened);
  return caustics * std::min(on_panel, kMaxObliquity * across) / std::sqrt(std::max(across, 1e-12));
}

ScatteringMatrix smooth_pattern(const CurvedFootprint& curvature, const Vec2& p) {
  ScatteringMatrix pattern{};
  for (int i = 0; i < 3; ++i) {
    const double weight = curvature.lambda.at(i, p);
    for (int q = 0; q < 4; ++q) pattern[q] += weight * curvature.pattern[i][q];
  }
  return pattern;
}

std::shared_ptr<const CurvedFootprint> make_curved_footprint(const CurvatureContext& on,
                                                             const BistaticGeometry& geometry,
                                                             const Interaction& interaction, const Footprint& footprint,
                                                             const Pattern& pattern) {
  const auto& [segment, candidate] = interaction;
  const auto& [transmit, receive, is_monostatic] = geometry;
  const int facet = candidate.projection.facet;
  const CurvedFacet* curved = on.surface.curved(facet);
  if (!curved && !segment.has_curved_reflection) return nullptr;
  const ArrivingRays rays = arriving_rays(segment, candidate);
  const ParaxialBundle& bundle = rays.bundle;
  auto corner = projected(on, segment, facet);
  if (!curved) corner = around_beam(segment);
  const Barycentric lambda(corner);

  // The surface is displaced by z / cos(incidence) along the ray, on both paths.
  const Mat3& L = segment.image_transform.L;
  const Vec3 both = transmit.r + L * receive.r;
  const double both_paths = both.dot(transmit.r);
  Quadratic standing;
  if (curved)
    standing = edge_midpoint_quadratic(
        lambda, edge_sagittas(on, segment, facet, [&](double cosine) { return both_paths / cosine; }));

  CurvedFootprint c{corner, lambda, bundle.phase, {}, {}, {}, {}, segment.has_curved_reflection, !curved, rays, {}, {}};
  c.phase += compose({0, footprint.w, Mat2::Zero()},
                     {bundle.position_map.offset, bundle.position_map.matrix - Mat2::Identity()});
  c.phase += compose(standing, bundle.position_map);
  if (c.has_bundle) {
    // The further path moves the rays on the panel by its length times their tilt.
    c.phase += product({-rays.path_slope.dot(rays.chief), rays.path_slope, Mat2::Zero()},
                       {footprint.w.dot(bundle.direction_map.offset),
                        bundle.direction_map.matrix.transpose() * footprint.w, Mat2::Zero()});
  }
  const double side = on.facets[facet].normal.dot(segment.direction) < 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    c.incident_shadow_distance[i] = c.receiver_shadow_distance[i] = std::numeric_limits<double>::infinity();
    c.w[i] = footprint.w + c.phase.slope(corner[i]);
    if (c.has_bundle) c.w[i] += rays.further_phase_slope(corner[i]);
    c.rise[i] = footprint.plane.slope;
    c.slope[i] = c.w[i];
    c.pattern[i] = pattern.value;
    if (curved) {
      const int vertex = curved->vertex[i];
      c.incident_shadow_distance[i] = on.surface.shadow_boundary_distance(vertex, -segment.direction, side);
      if (!is_monostatic || segment.bounce > 1)
        c.receiver_shadow_distance[i] = on.surface.shadow_boundary_distance(vertex, receive.r, side);
      const Vec3 n = side * on.surface.vertex(vertex).normal;
      const double cosine = smooth_cosine(segment, on.facets[facet], n);
      const Vec3 image = L * n;
      c.rise[i] = -Vec2(image.dot(transmit.h), image.dot(transmit.v)) / cosine;
      c.w[i] += both_paths * (c.rise[i] - footprint.plane.slope) - standing.slope(corner[i]);
      const Vec3 tangential = both - image * image.dot(both);
      c.slope[i] += Vec2(tangential.dot(transmit.h), tangential.dot(transmit.v)) +
                    tangential.dot(transmit.r) * footprint.plane.slope - footprint.w - standing.slope(corner[i]);
      if (pattern.at_node.empty()) c.pattern[i] = pec_pattern(segment, n, cosine, receive);
    }
  }
  return std::make_shared<const CurvedFootprint>(c);
}

namespace {

// Multiplies the pattern of a perfectly conducting footprint by a weight; the part above 1 is the transposed pattern
// (reciprocal path).
void weight_with_reciprocal(double weight, ScatteringMatrix& pattern) {
  const double there = std::min(weight, 1.0), back = weight - there;
  const auto [hh, hv, vh, vv] = pattern;
  pattern = {there * hh + back * hh, there * hv + back * vh, there * vh + back * hv, there * vv + back * vv};
}

// Of the reflections before the candidate. The width of a reflector is the area of its panel over its largest extent.
BeamHistory beam_history(const Interaction& interaction, const Scatterer& scatterer) {
  const auto& [segment, candidate] = interaction;
  if (!segment.previous) return {};
  const std::span<const Facet> facets = scatterer.facets();
  const int panel = candidate.projection.facet;
  // In image space a path is one straight line along the transmit direction.
  const Vec2 ray = centroid(candidate.illuminated.polygons().front());
  const double end = candidate.projection.plane.at(ray);
  double squared = 0, longest = 0;
  bool one_part = true;
  for (const BeamSegment* behind = &segment; behind->previous; behind = behind->previous) {
    const int reflector = behind->source_facet;
    const double length = behind->source_plane.at(ray) - end;
    longest = std::max(longest, length);
    squared += std::pow(2 * length / scatterer.panels().width(reflector), 2);
    one_part = one_part && facets[reflector].part == facets[panel].part;
  }
  return {static_cast<float>(std::sqrt(squared)), one_part ? static_cast<float>(longest / (segment.bounce - 1)) : 0};
}

}  // namespace

SurfaceRadiator::SurfaceRadiator(const TracingContext& scene, const Receiver& receiver, std::vector<Contribution>& out)
    : scene_(scene),
      facets_(scene.scatterer.facets()),
      curvature_{facets_, scene.scatterer.surface(), scene.transmit},
      panels_(scene.scatterer.panels()),
      geometry_(receiver.geometry),
      visible_(receiver.visible),
      basis_(scene.transmit),
      max_slide_rate_(2 * scene.scatterer.radius()),
      out_(out),
      boundary_(scene, receiver, out) {}

// The contribution of the candidate's panel after these reflections, but for phase, pattern and polygon.
Contribution SurfaceRadiator::contribution_of(const Interaction& interaction, const ImageTransform& image_transform,
                                              int bounces) const {
  const int facet = interaction.candidate.projection.facet;
  Footprint footprint;
  footprint.plane = interaction.candidate.projection.plane;
  footprint.image_transform = image_transform;
  footprint.panel_size = panels_.size(facet);
  footprint.history = beam_history(interaction, scene_.scatterer);
  const std::uint16_t part = facets_[facet].part;
  return {{}, {facet, part, part, static_cast<std::uint8_t>(bounces)}, std::move(footprint)};
}

void SurfaceRadiator::radiate(const Interaction& interaction, std::span<const MovingPolygon> pieces) {
  radiate_panel(interaction, pieces);
  radiate_image(interaction, pieces);
}

void SurfaceRadiator::radiate_panel(const Interaction& interaction, std::span<const MovingPolygon> pieces) {
  const auto& [segment, candidate] = interaction;
  const int facet = candidate.projection.facet;
  const Vec3 n = illuminated_normal(segment, facets_[facet]);
  if (pieces.empty() || n.dot(geometry_.receive.r) <= kEdgeOn) return;

  Contribution whole = contribution_of(interaction, segment.image_transform, segment.bounce);
  Footprint& footprint = std::get<Footprint>(whole.element);
  set_phase(footprint, segment.image_transform.L * facets_[facet].normal, geometry_);
  whole.pattern.value = pec_pattern(segment, n, std::abs(n.dot(segment.direction)), geometry_.receive);
  if (!segment.fields.empty() || !scene_.surface_of(facet).empty()) {
    whole.pattern.at_node = patterns(segment, facet, n);
    whole.pattern.value = whole.pattern.at_node[whole.pattern.at_node.size() / 2];
  }
  footprint.curvature = make_curved_footprint(curvature_, geometry_, interaction, footprint, whole.pattern);
  boundary_.start(interaction, whole);
  const double weight = uses_grazing_treatment(segment, facet) ? path_weight(segment, facet) : 1.0;
  // A weight above 1 applies to the boundary terms too; for a weight below 1 they are tapered equally
  // (reflected_edge_weight).
  if (weight > 1) weight_with_reciprocal(weight, whole.pattern.value);
  for (const MovingPolygon& piece : pieces) {
    footprint.polygon = piece;
    limit_slide_rate(footprint, max_slide_rate_);
    boundary_.append_terms(whole);
    if (weight <= 0) continue;
    out_.push_back(whole);
    if (weight < 1) weight_with_reciprocal(weight, out_.back().pattern.value);
  }
}

// Appends the footprints of the path that returns via its first reflector, where the grazing treatment applies: the
// panel's image in that reflector radiates instead (image theory). `visible`: visible part of the panel.
void SurfaceRadiator::radiate_image(const Interaction& interaction, std::span<const MovingPolygon> visible) {
  const auto& [segment, candidate] = interaction;
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
  Contribution via = contribution_of(interaction, segment.image_transform * by, segment.bounce + 1);
  Footprint& footprint = std::get<Footprint>(via.element);
  set_phase(footprint, segment.image_transform.L * illuminated_side, geometry_);
  via.pattern.value = pec_pattern(image, n, std::abs(n.dot(image.direction)), basis_);
  weight_with_reciprocal(weight, via.pattern.value);
  // The part that the reflector illuminates first is the part that a receiver at the same place sees via it.
  std::vector<MovingPolygon> by_reflector;
  if (segment.bounce > 2)
    visible_.visible_via_reflector(segment.first_reflector, facet, footprint.image_transform, visible, basis_,
                                   by_reflector);
  for (const MovingPolygon& piece :
       segment.bounce > 2 ? std::span<const MovingPolygon>(by_reflector) : candidate.illuminated.polygons()) {
    footprint.polygon = piece;
    limit_slide_rate(footprint, max_slide_rate_);
    out_.push_back(via);
  }
}

std::vector<ScatteringMatrix> SurfaceRadiator::patterns(const BeamSegment& segment, int facet, const Vec3& n) const {
  const std::span<const MaterialSurface> surface = scene_.surface_of(facet);
  const auto& [r, h, v] = geometry_.receive;
  const double cosine = std::abs(n.dot(segment.direction));
  std::vector<ScatteringMatrix> patterns(surface.empty() ? segment.fields.size() : surface.size());
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

bool SurfaceRadiator::uses_grazing_treatment(const BeamSegment& segment, int facet) const {
  return scene_.settings.edges && geometry_.monostatic && !segment.has_curved_reflection &&
         !curvature_.surface.curved(facet) && segment.fields.empty() && scene_.surface_of(facet).empty() &&
         !scene_.settings.filter.is_cavity(facets_[facet].part);
}

ReflectorPanel SurfaceRadiator::reflector_panel(int facet) const {
  return {facets_[facet].normal, panels_.outline(facet)};
}

double SurfaceRadiator::path_weight(const BeamSegment& segment, int last) const {
  if (segment.bounce == 1) return 1;
  const ReflectorPanel first = reflector_panel(segment.first_reflector);
  return segment.bounce > 2
             ? multiple_bounce_weight(basis_.r, first, reflector_panel(segment.source_facet), reflector_panel(last))
             : double_bounce_weight(basis_.r, first, reflector_panel(last));
}

}  // namespace seaglint

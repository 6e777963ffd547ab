// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/beam_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/scattering/coefficients/reflection.h"
#include "sim/scattering/geometry/cross_section.h"
#include "sim/scattering/geometry/tolerances.h"
#include "sim/scattering/tracing/curved_reflection.h"

namespace seaglint {
namespace {

// Halvings of the cross-section of a beam whose rays the border of a panel limits. The echo of a cylinder of 48 strips
// before a patch errs by 0.28, 0.13 to 0.18, 0.11 and 0.09 with 2, 4, 6 and 8 (cylinder_patch_test.cpp); a boat of
// 35,000 facets takes 1.4 times as long with 6 as without, and 1.4 times as long again with 8.
constexpr int kMaxHalvings = 6;

class BeamTracer {
 public:
  BeamTracer(const TracingContext& scene, const PanelSearch& search, InteractionVisitor& visitor)
      : scene_(scene),
        search_(search),
        facets_(scene.scatterer.facets()),
        curvature_{facets_, scene.scatterer.surface(), scene.transmit},
        basis_(scene.transmit),
        visitor_(visitor),
        scratch_(static_cast<std::size_t>(scene.settings.max_bounces) + 1) {}

  std::size_t segments() const { return segments_; }

  void trace_panel(int facet) {
    if (scene_.is_submerged(facet)) return;
    const BeamSegment first = transmitted();
    CandidatePanel candidate;
    candidate.projection.facet = facet;
    candidate.projection.plane = depth_plane(facets_[facet].normal, facets_[facet].offset, basis_);
    candidate.illuminated.assign(scene_.visible.pieces(facet));
    visit_candidate(first, candidate, scratch_[0].visible);
    if (continues(first, candidate)) trace_segment(reflected_segment(first, candidate), candidate.illuminated);
  }

  void trace_window(const PolygonSet& window, int path) {
    BeamSegment first = transmitted();
    first.path = path;
    trace_segment(first, window);
  }

 private:
  // Work memory of one bounce number, kept from segment to segment.
  struct Scratch {
    std::vector<FoundPanel> found;
    std::vector<CandidatePanel> met;  // grows to the largest number of candidates so far
    std::vector<FoundPanel> panel;    // of each candidate
    std::vector<Extent> extent;       // of the illuminated polygons of each candidate
    std::vector<std::uint32_t> order;
    std::vector<MovingPolygon> visible;
  };

  BeamSegment transmitted() const {
    BeamSegment first;
    first.direction = -basis_.r;
    first.E_h = basis_.h;
    first.E_v = basis_.v;
    return first;
  }

  // Passes the illuminated polygons and, for every receiver, their visible parts to the visitor. `seen`: work memory.
  void visit_candidate(const BeamSegment& segment, const CandidatePanel& candidate, std::vector<MovingPolygon>& seen) {
    const Interaction interaction{segment, candidate};
    visitor_.illuminated(interaction);
    const Vec3 illuminated_side = illuminated_normal(segment, facets_[candidate.projection.facet]);
    for (std::size_t i = 0; i < scene_.receivers.size(); ++i) {
      const BistaticGeometry& geometry = scene_.receivers[i].geometry;
      // At the first bounce a monostatic receiver sees exactly the illuminated polygons.
      if (segment.bounce == 1 && geometry.monostatic) {
        visitor_.visible(interaction, i, candidate.illuminated.polygons());
        continue;
      }
      seen.clear();
      if (illuminated_side.dot(geometry.receive.r) > kEdgeOn) search_.find_visible(segment, candidate, i, seen);
      visitor_.visible(interaction, i, seen);
    }
  }

  // Clips the projection to the half-space beyond the last reflector; false when nothing remains.
  static bool clip_beyond_source(const BeamSegment& segment, double min_area, ProjectedPanel& projection) {
    double farthest = 0, nearest = 0;  // distance beyond the last reflector along the ray, m
    for (const MovingVertex& vertex : projection.polygon) {
      const double beyond = segment.source_plane.at(vertex.p) - projection.plane.at(vertex.p);
      farthest = std::max(farthest, beyond);
      nearest = std::min(nearest, beyond);
    }
    if (farthest < kCoincident) return false;  // it is coplanar with the last reflector or behind it
    if (nearest >= 0) return true;
    projection.polygon = clip(projection.polygon, depth_difference(projection.plane, segment.source_plane), +1);
    return !projection.polygon.empty() && signed_area(projection.polygon) >= min_area;
  }

  // Projects the panel, clips it to the half-space beyond the last reflector and intersects it with the beam
  // cross-section `window`; false when nothing remains.
  bool intersect_panel(const BeamSegment& segment, const PolygonSet& window, const BvhPanel& panel,
                       CandidatePanel& candidate) const {
    ProjectedPanel& projection = candidate.projection;
    const double min_area = scene_.min_area.on(panel.facet);
    if (!project_panel(projection, panel, segment.image_transform, basis_, min_area)) return false;
    if (segment.source_facet != kNoFacet && !clip_beyond_source(segment, min_area, projection)) return false;
    const Box box = box_of(projection.polygon);
    candidate.illuminated.clear();
    for (std::size_t i = 0; i < window.size(); ++i) {
      if (!overlap(window.boxes()[i], box)) continue;
      MovingPolygon common = intersect(window.polygons()[i], window.boxes()[i], projection.polygon);
      if (!common.empty() && signed_area(common) > min_area) candidate.illuminated.push_back(std::move(common));
    }
    return !candidate.illuminated.empty();
  }

  // Illuminates the panels in the path of a segment with the given cross-section (convex pieces in the projection
  // plane) and follows their reflections.
  void trace_segment(const BeamSegment& segment, const PolygonSet& window) {
    ++segments_;
    Scratch& scratch = scratch_[segment.bounce];
    scratch.found.clear();
    search_.find(segment, window, scratch.found);
    // The last segment of a beam contributes only on panels that a receiver sees, or at edges.
    const auto seen = [&](const FoundPanel& found) { return search_.may_be_seen(found.panel->facet); };
    if (segment.bounce == scene_.settings.max_bounces && !visitor_.needs_last_segment(segment) &&
        std::ranges::none_of(scratch.found, seen))
      return;

    illuminate(segment, window, 0);
  }

  // Illuminates the panels found in the path of a segment, or of a part of its cross-section after that many halvings.
  void illuminate(const BeamSegment& segment, const PolygonSet& window, int halvings) {
    Scratch& scratch = scratch_[segment.bounce];
    std::vector<CandidatePanel>& met = scratch.met;
    std::vector<Extent>& extent = scratch.extent;
    extent.clear();
    scratch.panel.clear();
    for (const FoundPanel& found : scratch.found) {
      if (met.size() == extent.size()) met.emplace_back();
      CandidatePanel& next = met[extent.size()];
      if (!intersect_panel(segment, window, *found.panel, next)) continue;
      next.path = found.path;
      extent.push_back(extent_of(next.illuminated.polygons(), next.projection.plane));
      scratch.panel.push_back(found);
    }
    std::vector<std::uint32_t>& order = scratch.order;
    order.resize(extent.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return extent[a].nearest != extent[b].nearest ? extent[a].nearest > extent[b].nearest
                                                    : met[a].projection.facet < met[b].projection.facet;
    });

    // Occlusion in order of nearest distance: every panel is subtracted from the parts of the others that are behind
    // it. A fully occluded panel need not be subtracted, since its own occluders cover everything it does.
    const auto hides = [&](std::uint32_t front, std::uint32_t behind) {
      if (!may_occlude(extent[behind], extent[front])) return;
      occlude(met[behind].projection, extent[behind], met[front].projection, extent[front],
              scene_.min_area.on(met[behind].projection.facet), met[behind].illuminated);
      if (met[behind].illuminated.empty()) extent[behind] = empty_extent();
    };
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) hides(order[j], order[i]);
      for (std::size_t j = 0; j < i; ++j) hides(order[i], order[j]);
    }

    if (halvings < kMaxHalvings && rays_are_limited(segment, window)) {
      illuminate_halves(segment, window, halvings + 1);
      return;
    }
    for (const std::uint32_t i : order) {
      const CandidatePanel& candidate = met[i];
      if (candidate.illuminated.empty() || scene_.is_submerged(candidate.projection.facet)) continue;
      visit_candidate(segment, candidate, scratch.visible);
      if (continues(segment, candidate)) trace_segment(reflected_segment(segment, candidate), candidate.illuminated);
    }
  }

  // True where the rays that leave the first curved reflector of a path are limited on a panel that they illuminate,
  // next to its border as a rule. Later reflectors are not examined: their parts would multiply; nor are cross-sections
  // whose halves would not be followed to further reflectors.
  bool rays_are_limited(const BeamSegment& segment, const PolygonSet& window) const {
    if (!segment.has_curved_reflection || segment.previous->has_curved_reflection) return false;
    if (window.area() < 2 * scene_.min_beam_per_patch * scene_.min_area.on(segment.source_facet)) return false;
    const Scratch& scratch = scratch_[segment.bounce];
    return std::ranges::any_of(scratch.order, [&](std::uint32_t i) {
      const CandidatePanel& candidate = scratch.met[i];
      return !candidate.illuminated.empty() && !scene_.is_submerged(candidate.projection.facet) &&
             arriving_rays(segment, candidate).scale < segment.curvature_scale;
    });
  }

  // Illuminates the panels that a segment illuminates by the two halves of its cross-section, so that only small parts
  // of it are limited.
  void illuminate_halves(const BeamSegment& segment, const PolygonSet& window, int halvings) {
    Scratch& scratch = scratch_[segment.bounce];
    std::vector<FoundPanel> illuminated;
    for (const std::uint32_t i : scratch.order) {
      if (!scratch.met[i].illuminated.empty()) illuminated.push_back(scratch.panel[i]);
    }
    for (const PolygonSet& half : halved(window, segment.source_plane)) {
      if (half.empty()) continue;
      BeamSegment of_half = segment;
      of_half.cross_section = &half;
      scratch.found = illuminated;
      illuminate(of_half, half, halvings);
    }
  }

  // Reflected field per wavenumber, where this reflector or an earlier one is not a perfect conductor.
  std::vector<BeamField> reflected_fields(const BeamSegment& segment, int facet, const Vec3& n) const {
    const std::span<const MaterialSurface> surface = scene_.surface_of(facet);
    const double cosine = std::abs(n.dot(segment.direction));
    std::vector<BeamField> fields(surface.empty() ? segment.fields.size() : surface.size());
    for (std::size_t q = 0; q < fields.size(); ++q) {
      const InterfaceCoefficients at = surface.empty() ? InterfaceCoefficients{} : surface[q].at(cosine);
      const double coherence = surface.empty() ? 1.0 : surface[q].roughness_factor(cosine, cosine);
      const BeamField before = field_at(segment, q);
      fields[q] = {coherence * reflected_field(at, segment.direction, n, before.h),
                   coherence * reflected_field(at, segment.direction, n, before.v)};
    }
    return fields;
  }

  // The segment that the candidate reflects. Geometrical optics at a perfect conductor: E' = 2 (n.E) n - E.
  BeamSegment reflected_segment(const BeamSegment& segment, const CandidatePanel& candidate) const {
    const int facet = candidate.projection.facet;
    const Vec3 n = illuminated_normal(segment, facets_[facet]);
    const double offset = n.dot(facets_[facet].corner[0]);
    BeamSegment next;
    next.image_transform = segment.image_transform * plane_reflection(n, offset);
    next.direction = reflect_direction(segment.direction, n);
    next.E_h = 2 * n.dot(segment.E_h) * n - segment.E_h;
    next.E_v = 2 * n.dot(segment.E_v) * n - segment.E_v;
    if (!segment.fields.empty() || !scene_.surface_of(facet).empty()) next.fields = reflected_fields(segment, facet, n);
    next.source_facet = facet;
    next.source_plane = candidate.projection.plane;
    next.source_normal = n;
    next.bounce = segment.bounce + 1;
    next.first_reflector_normal = segment.bounce == 1 ? n : reflect_direction(segment.first_reflector_normal, n);
    next.path = candidate.path;
    next.previous = &segment;
    next.first_reflector = segment.bounce == 1 ? facet : segment.first_reflector;
    reflect_rays(curvature_, segment, candidate, next);
    return next;
  }

  // False at max_bounces, at the wall of a cavity, and for cross-sections below the smallest of this body.
  bool continues(const BeamSegment& segment, const CandidatePanel& candidate) const {
    if (segment.bounce >= scene_.settings.max_bounces ||
        scene_.settings.filter.is_cavity(facets_[candidate.projection.facet].part))
      return false;
    return candidate.illuminated.area() >= scene_.min_beam_per_patch * scene_.min_area.on(candidate.projection.facet);
  }

  const TracingContext& scene_;
  const PanelSearch& search_;
  std::span<const Facet> facets_;
  CurvatureContext curvature_;
  const RadarBasis& basis_;  // of the projection plane: the transmitter's
  InteractionVisitor& visitor_;
  std::vector<Scratch> scratch_;  // indexed by bounce number
  std::size_t segments_ = 0;
};

}  // namespace

std::size_t trace_beams(const TracingContext& scene, const PanelSearch& search, std::span<const int> facets,
                        InteractionVisitor& visitor, const std::function<void()>& after_each) {
  BeamTracer tracer(scene, search, visitor);
  for (const int facet : facets) {
    tracer.trace_panel(facet);
    after_each();
  }
  return tracer.segments();
}

std::size_t trace_window(const TracingContext& scene, const PanelSearch& search, const PolygonSet& window, int path,
                         InteractionVisitor& visitor) {
  BeamTracer tracer(scene, search, visitor);
  tracer.trace_window(window, path);
  return tracer.segments();
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Interaction of a wave with a panel, and what a tracer needs to find it: the beam segment that arrives, the panels in
// its path, the scene, and the search of panels, with the prism of a beam or with rays.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/geometry/surface/facets.h"
#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/geometry/moving_polygon.h"
#include "sim/scattering/geometry/paraxial_bundle.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/scatterer/panel_bvh.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "sim/scattering/tracing/visible_surface.h"

namespace seaglint {

// Parallel rays from the last reflector towards the next panels. The segments of one beam form a list through
// `previous`; the first one comes from the transmitter.
struct BeamSegment {
  ImageTransform image_transform;  // real space to image space, all reflections so far
  Vec3 direction;                  // of propagation, real space, unit
  Vec3 E_h, E_v;  // field per unit h and v transmit polarisation, real space, all reflectors perfect conductors
  std::vector<BeamField> fields;      // the same per wavenumber once a reflector is not a perfect conductor, else empty
  int source_facet = kNoFacet;        // first facet of the last reflector; kNoFacet: the transmitter
  DepthPlane source_plane;            // plane of the last reflector, image space
  Vec3 source_normal = Vec3::Zero();  // its unit normal on the illuminated side, real space
  int bounce = 1;                     // number of the reflection at the end of the segment, from 1
  // Unit normal of the first reflector, mirrored in the later ones; zero before the first reflection.
  Vec3 first_reflector_normal = Vec3::Zero();
  int first_reflector = -1;            // its first facet; -1 before the first reflection
  int path = -1;                       // number of the sequence of its reflectors (FoundPanel), -1: none
  bool has_curved_reflection = false;  // one of the reflectors so far is curved
  // Where a reflector was curved: the rays as they leave the last one, psi that its curvature adds, m, the chief ray's
  // way from the one before, m, and the factor of all curvatures on the path (curved_reflection.h).
  ParaxialBundle ray_bundle;
  Quadratic reflector_curvature;
  double path_m = 0, curvature_scale = 1;
  const PolygonSet* cross_section = nullptr;  // of the beam as it leaves the last reflector
  const BeamSegment* previous = nullptr;      // segment that ends at the last reflector
};

// Panel that a segment may illuminate, with its illuminated polygons; these shrink as occluders are subtracted.
struct CandidatePanel {
  ProjectedPanel projection;  // polygon clipped to the side of the last reflector that the segment leaves
  PolygonSet illuminated;
  int path = -1;  // as FoundPanel::path
};

// Reflection of a beam at a panel: the segment with its path, field and image transform, and the panel with its
// illuminated polygons.
struct Interaction {
  const BeamSegment& segment;
  const CandidatePanel& candidate;
};

// Receives the interactions of all beams.
class InteractionVisitor {
 public:
  virtual ~InteractionVisitor() = default;
  // True when a last segment (bounce = max_bounces) must be traced although no receiver sees any panel in its path.
  virtual bool needs_last_segment(const BeamSegment& segment) const = 0;
  // Called once for every segment and panel.
  virtual void illuminated(const Interaction& interaction) = 0;
  // Called next for every receiver: the convex parts of the illuminated polygons with an unobstructed direct path to
  // it, in the projection plane of the transmitter; may be empty.
  virtual void visible(const Interaction& interaction, std::size_t receiver, std::span<const MovingPolygon> pieces) = 0;
};

// Field at wavenumber index q.
inline BeamField field_at(const BeamSegment& segment, std::size_t q) {
  return segment.fields.empty() ? BeamField{segment.E_h.cast<Complex>(), segment.E_v.cast<Complex>()}
                                : segment.fields[q];
}

// Unit normal of the facet on its illuminated side.
inline Vec3 illuminated_normal(const BeamSegment& segment, const Facet& facet) {
  return facet.normal.dot(segment.direction) < 0 ? facet.normal : Vec3(-facet.normal);
}

// Pattern hh, hv, vh, vv (received, transmitted) of the physical-optics current on a perfect conductor, p . [n x (k^ x
// E)] / cosine, per unit of projected area. n: unit normal on the illuminated side; cosine = |n . k^| > 0, k^ the
// segment's direction. J = 2 n x H: C. A. Balanis, Advanced Engineering Electromagnetics, eqs. 6-95 and 7-54.
inline std::array<Complex, 4> pec_pattern(const BeamSegment& segment, const Vec3& n, double cosine,
                                          const RadarBasis& receive) {
  const Vec3 J_h = n.cross(segment.direction.cross(segment.E_h)) / cosine;
  const Vec3 J_v = n.cross(segment.direction.cross(segment.E_v)) / cosine;
  return {receive.h.dot(J_h), receive.h.dot(J_v), receive.v.dot(J_h), receive.v.dot(J_v)};
}

// Receiver of one illumination. geometry: the transmitter and this receiver.
struct Receiver {
  BistaticGeometry geometry;
  const VisibleSurface& visible;  // part of the surface that it sees
};

// What the beams of one transmit direction have in common.
struct TracingContext {
  const Scatterer& scatterer;
  const RadarBasis& transmit;
  std::span<const Receiver> receivers;  // none: beams are traced for their illumination only
  const TracingSettings& settings;
  const VisibleSurface& visible;                           // directly illuminated part of the surface
  std::span<const std::vector<MaterialSurface>> surfaces;  // [material][wavenumber]; none for a perfect conductor
  SmallestAreas min_area;                                  // of illuminated patches that are kept, m^2
  double min_beam_per_patch = 1;  // area of the smallest beam cross-section that is reflected further over min_area

  // Material of the facet at each wavenumber; empty for a perfect conductor.
  std::span<const MaterialSurface> surface_of(int facet) const {
    if (surfaces.empty()) return {};
    return surfaces[scatterer.facets()[facet].material];
  }
  bool ends_beams(int facet) const {
    const std::span<const MaterialSurface> surface = surface_of(facet);
    return !surface.empty() && surface.front().ends_beams();
  }
};

// A panel in the way of a segment. `path`: number by which the search knows the sequence of reflectors up to this
// panel; -1: none.
struct FoundPanel {
  const BvhPanel* panel = nullptr;
  std::int32_t path = -1;
};

class PanelSearch {
 public:
  virtual ~PanelSearch() = default;

  // Appends the panels that a segment with this cross-section may illuminate, and those that obstruct them; further
  // panels do no harm. Never the panel that the segment leaves.
  virtual void find(const BeamSegment& segment, const PolygonSet& cross_section,
                    std::vector<FoundPanel>& found) const = 0;

  // Appends the convex parts of the candidate's illuminated polygons that have an unobstructed direct path to the
  // receiver, in the projection plane of the transmitter.
  virtual void find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                            std::vector<MovingPolygon>& visible) const = 0;

  // False only where no receiver sees any part of the panel with this first facet directly.
  virtual bool may_be_seen(int facet) const = 0;
};

}  // namespace seaglint

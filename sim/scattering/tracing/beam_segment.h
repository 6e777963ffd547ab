// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Beam segment, the part of a beam between two consecutive reflections, and a panel that it may illuminate.

#include <vector>

#include "sim/scattering/coefficients/reflection.h"
#include "sim/scattering/geometry/polygon_set.h"
#include "sim/scattering/geometry/ray_bundle.h"
#include "sim/scattering/scatterer/facets.h"
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

}  // namespace seaglint

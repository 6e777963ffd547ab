// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A beam between two mirrors, and a facet at its end.

#include <vector>

#include "sim/scattering/beams/ray_bundle.h"
#include "sim/scattering/beams/visible_surface.h"
#include "sim/scattering/material/reflection.h"
#include "sim/scattering/target/facets.h"

namespace seaglint {

// One leg of a beam: what travels from the last mirror towards the next facet.
struct BeamSegment {
  ImageTransform image_transform;  // of the facets passed
  Vec3 direction;                  // real, unit
  Vec3 E_h, E_v;                  // field for each transmitted polarisation, real space, all mirrors perfect conductors
  std::vector<BeamField> fields;  // the field per wavenumber once a mirror was of another material
  int source_facet = kNoFacet;
  DepthPlane source_plane;            // of the last mirror
  Vec3 source_normal = Vec3::Zero();  // real, on the side the beam leaves
  int bounce = 1;                     // of the hits at this leg's end
  Vec3 first_reflector_normal =
      Vec3::Zero();          // normal of the first one as those after it show it to this leg, unit; none before
  int first_reflector = -1;  // the first one itself
  bool has_curved_reflection = false;     // a mirror on the way was curved:
  ParaxialBundle ray_bundle;              // the rays as they left the last mirror
  const BeamSegment* previous = nullptr;  // the leg to the last mirror
};

// A facet that a leg may light, and what of it is lit as far as is known.
struct CandidatePanel {
  ProjectedPanel projection;  // its polygon clipped to what lies beyond the last mirror
  PolygonSet illuminated;
};

// The leg's field at wavenumber number q.
inline BeamField field_at(const BeamSegment& segment, std::size_t q) {
  return segment.fields.empty() ? BeamField{segment.E_h.cast<Complex>(), segment.E_v.cast<Complex>()}
                                : segment.fields[q];
}

// The facet's unit normal on the side the leg comes from.
inline Vec3 illuminated_normal(const BeamSegment& segment, const Facet& facet) {
  return facet.normal.dot(segment.direction) < 0 ? facet.normal : Vec3(-facet.normal);
}

// hh, hv, vh, vv of n x (k^ x E) / cosine along the receiver's basis: what a perfect conductor with normal n radiates.
inline std::array<Complex, 4> pec_pattern(const BeamSegment& segment, const Vec3& n, double cosine,
                                          const RadarBasis& receive) {
  const Vec3 J_h = n.cross(segment.direction.cross(segment.E_h)) / cosine;
  const Vec3 J_v = n.cross(segment.direction.cross(segment.E_v)) / cosine;
  return {receive.h.dot(J_h), receive.h.dot(J_v), receive.v.dot(J_h), receive.v.dot(J_v)};
}

}  // namespace seaglint

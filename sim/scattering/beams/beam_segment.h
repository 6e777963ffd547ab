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
struct Leg {
  Mirror mirrors;                 // of the facets passed
  Vec3 direction;                 // real, unit
  Vec3 E_h, E_v;                  // field for each transmitted polarisation, real space, all mirrors perfect conductors
  std::vector<BeamField> fields;  // the field per wavenumber once a mirror was of another material
  int from_facet = kNoFacet;
  ImagePlane from_plane;             // of the last mirror
  Vec3 from_normal = Vec3::Zero();   // real, on the side the beam leaves
  int bounce = 1;                    // of the hits at this leg's end
  Vec3 first_mirror = Vec3::Zero();  // normal of the first one as those after it show it to this leg, unit; none before
  int first_facet = -1;              // the first one itself
  bool bent = false;                 // a mirror on the way was curved:
  BentRays rays;                     // the rays as they left the last mirror
  const Leg* before = nullptr;       // the leg to the last mirror
};

// A facet that a leg may light, and what of it is lit as far as is known.
struct Candidate {
  FacetImage image;  // its polygon clipped to what lies beyond the last mirror
  Pieces lit;
};

// The leg's field at wavenumber number q.
inline BeamField field_at(const Leg& leg, std::size_t q) {
  return leg.fields.empty() ? BeamField{leg.E_h.cast<Complex>(), leg.E_v.cast<Complex>()} : leg.fields[q];
}

// The facet's unit normal on the side the leg comes from.
inline Vec3 facing(const Leg& leg, const Facet& facet) {
  return facet.normal.dot(leg.direction) < 0 ? facet.normal : Vec3(-facet.normal);
}

// hh, hv, vh, vv of n x (k^ x E) / cosine along the receiver's basis: what a perfect conductor with normal n radiates.
inline std::array<Complex, 4> conductor_pattern(const Leg& leg, const Vec3& n, double cosine,
                                                const RadarBasis& receive) {
  const Vec3 J_h = n.cross(leg.direction.cross(leg.E_h)) / cosine;
  const Vec3 J_v = n.cross(leg.direction.cross(leg.E_v)) / cosine;
  return {receive.h.dot(J_h), receive.h.dot(J_v), receive.v.dot(J_h), receive.v.dot(J_v)};
}

}  // namespace seaglint

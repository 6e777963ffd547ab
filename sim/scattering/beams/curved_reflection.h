// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Paraxial ray bundles reflected by curved facets (sim/scattering/surfaces/README.md, "Curved surfaces").

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sim/scattering/beams/beam_segment.h"
#include "sim/scattering/beams/ray_bundle.h"
#include "sim/scattering/target/smooth_surface.h"

namespace seaglint {

// What the beams of one illumination have in common.
struct CurvatureContext {
  std::span<const Facet> facets;
  const SmoothSurface& surface;
  const RadarBasis& transmit;  // basis of the projection plane
};

// Rays of a segment at a panel, and the factor 0 < scale <= 1 of the curvature of all reflectors on their path.
struct ArrivingRays {
  ParaxialBundle bundle;
  double scale = 1;
};

// The segment's rays at the candidate, of reflectors whose curvature is reduced until the bundle is paraxial: no ray at
// a corner of the cross-section is tilted by more than kMaxTilt, and either none is displaced by more than half the
// width of the cross-section along its displacement or all stay on the candidate, where the boundary of what they
// illuminate does not matter. The factor is a continuous function of the geometry.
ArrivingRays arriving_rays(const BeamSegment& segment, const CandidatePanel& candidate);

// A point, and the corners of a facet, in the projection plane after the reflections of the segment, m.
Vec2 projected(const CurvatureContext& on, const BeamSegment& segment, const Vec3& x);
std::array<Vec2, 3> projected(const CurvatureContext& on, const BeamSegment& segment, int facet);

// Sagittas of a curved facet's three edges on the illuminated side, m, each times `factor` of the cosine of incidence
// at the edge. That cosine is at least 8 sagitta / length, twice the half-angle of the edge's arc, since currents
// vanish near the shadow boundary.
template <typename Factor>
std::array<double, 3> edge_sagittas(const CurvatureContext& on, const BeamSegment& segment, int facet,
                                    const Factor& factor) {
  const CurvedFacet& curved = *on.surface.curved(facet);
  const Facet& flat = on.facets[facet];
  const double side = flat.normal.dot(segment.direction) < 0 ? 1 : -1;
  std::array<double, 3> middle;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec3 mean =
        side * (on.surface.vertex(curved.vertex[i]).normal + on.surface.vertex(curved.vertex[j]).normal).normalized();
    const double min = 8 * std::abs(curved.sagitta[i]) / (flat.corner[j] - flat.corner[i]).norm();
    middle[i] = side * curved.sagitta[i] * factor(std::max({-mean.dot(segment.direction), min, 1e-6}));
  }
  return middle;
}

// Sets the rays of `next`, the segment that the candidate reflects, where it or an earlier reflector is curved.
void reflect_rays(const CurvatureContext& on, const BeamSegment& segment, const CandidatePanel& candidate,
                  BeamSegment& next);

}  // namespace seaglint

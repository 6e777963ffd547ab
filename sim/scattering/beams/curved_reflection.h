// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What curved facets do to the rays of a beam when they are mirrors (README.md, "Curved surfaces").

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sim/scattering/beams/beam_segment.h"
#include "sim/scattering/beams/ray_bundle.h"
#include "sim/scattering/target/smooth_surface.h"

namespace seaglint {

// What all beams of an illumination share.
struct CurvatureContext {
  std::span<const Facet> facets;
  const SmoothSurface& surface;
  const RadarBasis& transmit;  // of the aperture
};

// The rays where they meet the candidate's plane.
ParaxialBundle propagated_to(const BeamSegment& segment, const CandidatePanel& candidate);

// A point, and a facet's corners, in the aperture, through the leg's mirrors.
Vec2 projected(const CurvatureContext& on, const BeamSegment& segment, const Vec3& x);
std::array<Vec2, 3> projected(const CurvatureContext& on, const BeamSegment& leg, int facet);

// The sagittas of a curved facet's edges on the leg's side, each times a factor of the cosine of the incidence there.
// An edge whose arc of half-angle 4 sagitta / length comes near the shadow boundary, where currents have faded, keeps
// twice that angle from it.
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

// The rays as they leave the candidate; those of flat mirrors where neither it nor one before it is curved.
ParaxialBundle reflected_bundle(const CurvatureContext& on, const BeamSegment& segment,
                                const CandidatePanel& candidate);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Paraxial ray bundles reflected by curved facets (sim/scattering/radiation/README.md, "Curved surfaces").

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sim/geometry/surface/smooth_surface.h"
#include "sim/scattering/geometry/paraxial_bundle.h"
#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// What the beams of one illumination have in common.
struct CurvatureContext {
  std::span<const Facet> facets;
  const SmoothSurface& surface;
  const RadarBasis& transmit;  // basis of the projection plane
};

// Rays of a segment on a panel, which the rays of one bundle reach after paths of different lengths. `bundle`: at the
// path length of the chief ray.
struct ArrivingRays {
  ParaxialBundle bundle;
  double scale = 1;                // factor 0 < x <= 1 of the curvature of all reflectors on the path
  Vec2 chief = Vec2::Zero();       // of the projection plane, m
  Vec2 path_slope = Vec2::Zero();  // gradient of the path length to the panel

  // Path of the ray p beyond that of the chief ray, m.
  double further_path(const Vec2& p) const { return path_slope.dot(p - chief); }
  // Position of the ray p on the panel, in the projection plane, m.
  Vec2 position(const Vec2& p) const {
    return bundle.position_map.at(p) + further_path(p) * bundle.direction_map.at(p);
  }
  // Derivatives by p of the position across the ray, at one length of the path, and of that on the panel.
  Mat2 spreading(const Vec2& p) const {
    return bundle.position_map.matrix + further_path(p) * bundle.direction_map.matrix;
  }
  Mat2 panel_spreading(const Vec2& p) const {
    return spreading(p) + outer_product(bundle.direction_map.at(p), path_slope);
  }
  // psi of the further path, - further_path |tilt|^2 / 2, m, and its gradient.
  double further_phase(const Vec2& p) const {
    return -0.5 * further_path(p) * bundle.direction_map.at(p).squaredNorm();
  }
  Vec2 further_phase_slope(const Vec2& p) const {
    const Vec2 tilt = bundle.direction_map.at(p);
    return -0.5 * tilt.squaredNorm() * path_slope - further_path(p) * (bundle.direction_map.matrix.transpose() * tilt);
  }
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

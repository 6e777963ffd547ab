// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/surfaces/curved_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seaglint {
namespace {

// Triangle of a flat panel's first facet, enlarged until it encloses the whole panel. It depends on the panel alone:
// adjoining footprints on the panel are divided equally, and their contour terms cancel.
std::array<Vec2, 3> around_panel(const CurvatureContext& on, const BeamSegment& segment, std::span<const Vec3> outline,
                                 const std::array<Vec2, 3>& first) {
  if (outline.size() == 3) return first;
  const Barycentric lambda(first);
  std::array<double, 3> min{};
  for (const Vec3& x : outline) {
    const Vec2 p = projected(on, segment, x);
    for (int i = 0; i < 3; ++i) min[i] = std::min(min[i], lambda.at(i, p));
  }
  std::array<Vec2, 3> corner;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    corner[i] = (1 - min[j] - min[l]) * first[i] + min[j] * first[j] + min[l] * first[l];
  }
  return corner;
}

// Cosine of incidence at a normal of the smooth surface; kept positive beyond the shadow boundary, where the current is
// zero.
double smooth_cosine(const BeamSegment& segment, const Facet& flat, const Vec3& normal) {
  return std::max(-normal.dot(segment.direction), 0.25 * std::abs(flat.normal.dot(segment.direction)));
}

}  // namespace

std::shared_ptr<const CurvedFootprint> make_curved_footprint(const CurvatureContext& on, const Panels& panels,
                                                             const BistaticGeometry& geometry,
                                                             const BeamSegment& segment,
                                                             const CandidatePanel& candidate,
                                                             const Footprint& footprint) {
  const auto& [transmit, receive, is_monostatic] = geometry;
  const int facet = candidate.projection.facet;
  const CurvedFacet* curved = on.surface.curved(facet);
  if (!curved && !segment.has_curved_reflection) return nullptr;
  const ParaxialBundle bundle = arriving_rays(segment, candidate).bundle;
  auto corner = projected(on, segment, facet);
  if (!curved) corner = around_panel(on, segment, panels.outline(facet), corner);
  const Barycentric lambda(corner);

  // The surface is displaced by z / cos(incidence) along the ray, on both paths.
  const Mat3& L = segment.image_transform.L;
  const Vec3 both = transmit.r + L * receive.r;
  const double both_paths = both.dot(transmit.r);
  Quadratic standing;
  if (curved)
    standing = edge_midpoint_quadratic(
        lambda, edge_sagittas(on, segment, facet, [&](double cosine) { return both_paths / cosine; }));

  CurvedFootprint c{corner, lambda, bundle.phase, {}, {}, {}, {}, {}, {}};
  c.phase += compose({0, footprint.w, Mat2::Zero()},
                     {bundle.position_map.offset, bundle.position_map.matrix - Mat2::Identity()});
  c.phase += compose(standing, bundle.position_map);
  // A bundle widened by the determinant illuminates a larger area with a weaker field: amplitude times the square root.
  // The phase advances by 90 deg behind one caustic and by 180 deg behind two.
  const double widened = bundle.position_map.matrix.determinant();
  c.divergence_factor = std::sqrt(std::abs(widened)) * (widened < 0                              ? Complex(0, 1)
                                                        : bundle.position_map.matrix.trace() < 0 ? Complex(-1)
                                                                                                 : Complex(1));
  const double side = on.facets[facet].normal.dot(segment.direction) < 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    c.incident_shadow_distance[i] = c.receiver_shadow_distance[i] = std::numeric_limits<double>::infinity();
    c.w[i] = c.slope[i] = footprint.w + c.phase.slope(corner[i]);
    c.pattern[i] = footprint.pattern;
    if (curved) {
      const int vertex = curved->vertex[i];
      c.incident_shadow_distance[i] = on.surface.shadow_boundary_distance(vertex, -segment.direction, side);
      if (!is_monostatic || segment.bounce > 1)
        c.receiver_shadow_distance[i] = on.surface.shadow_boundary_distance(vertex, receive.r, side);
      const Vec3 n = side * on.surface.vertex(vertex).normal;
      const double cosine = smooth_cosine(segment, on.facets[facet], n);
      const Vec3 image = L * n;
      const Vec2 slope = -Vec2(image.dot(transmit.h), image.dot(transmit.v)) / cosine;
      c.w[i] += both_paths * (slope - footprint.plane.slope) - standing.slope(corner[i]);
      const Vec3 tangential = both - image * image.dot(both);
      c.slope[i] += Vec2(tangential.dot(transmit.h), tangential.dot(transmit.v)) +
                    tangential.dot(transmit.r) * footprint.plane.slope - footprint.w - standing.slope(corner[i]);
      if (footprint.patterns.empty()) c.pattern[i] = pec_pattern(segment, n, cosine, receive);
    }
  }
  return std::make_shared<const CurvedFootprint>(c);
}

}  // namespace seaglint

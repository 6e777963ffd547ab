// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/curved_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
                                                             const Interaction& interaction,
                                                             const Footprint& footprint, const Pattern& pattern) {
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

}  // namespace seaglint

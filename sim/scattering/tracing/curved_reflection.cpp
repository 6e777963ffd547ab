// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/curved_reflection.h"

#include <limits>

#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {

namespace {

// Largest tilt of a ray against the flat bundle, rad: the third order of the path, s tilt^4 / 8, is then 2 mm per
// metre.
constexpr double kMaxTilt = 0.35;

// Centroid of all polygons of a panel that the segment illuminates.
Vec2 chief_ray(const CandidatePanel& candidate) {
  Vec2 moment = Vec2::Zero();
  double area = 0;
  for (const MovingPolygon& polygon : candidate.illuminated.polygons()) {
    const double own = signed_area(polygon);
    moment += own * centroid(polygon);
    area += own;
  }
  return area > 0 ? Vec2(moment / area) : centroid(candidate.illuminated.polygons().front());
}

// Path of a ray from the last reflector to the panel, m.
double distance_to(const BeamSegment& segment, const CandidatePanel& candidate, const Vec2& ray) {
  return std::max(0.0, segment.source_plane.at(ray) - candidate.projection.plane.at(ray));
}

// Rays as they leave the segment's last reflector, with all curvatures on the path times `scale`.
ParaxialBundle leaving_rays(const BeamSegment& segment, double scale) {
  if (!segment.has_curved_reflection) return {};
  ParaxialBundle bundle = leaving_rays(*segment.previous, scale);
  bundle.propagate(segment.path_m);
  Quadratic added = segment.reflector_curvature;
  added *= scale;
  bundle.reflect(added);
  return bundle;
}

// Largest displacement of a ray at a corner of the cross-section, in halves of the width along that displacement.
double relative_displacement(const PolygonSet& cross_section, const ArrivingRays& rays) {
  double largest = 0;
  for (const MovingPolygon& polygon : cross_section.polygons()) {
    for (const MovingVertex& vertex : polygon) {
      const Vec2 moved = rays.position(vertex.p) - vertex.p;
      const double length = moved.norm();
      if (length == 0) continue;
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const MovingPolygon& other : cross_section.polygons()) {
        for (const MovingVertex& at : other) {
          low = std::min(low, moved.dot(at.p));
          high = std::max(high, moved.dot(at.p));
        }
      }
      largest = std::max(largest, 2 * length * length / std::max(high - low, 1e-12 * length));
    }
  }
  return largest;
}

// Largest displacement of a ray at a corner of the illuminated polygons towards a side of the panel, relative to the
// corner's distance from that side: at most 1 where all rays stay on the panel.
double relative_to_panel(const CandidatePanel& candidate, const ArrivingRays& rays) {
  const MovingPolygon& panel = candidate.projection.polygon;
  double largest = 0;
  for (const MovingPolygon& polygon : candidate.illuminated.polygons()) {
    for (const MovingVertex& vertex : polygon) {
      const Vec2 moved = rays.position(vertex.p) - vertex.p;
      for (std::size_t i = 0; i < panel.size(); ++i) {
        const Vec2 &a = panel[i].p, side = panel[(i + 1) % panel.size()].p - a;
        const Vec2 outward = Vec2(side.y(), -side.x()).normalized();
        // Rays that have not left the reflector's own plane, with which the panel ends, are displaced by rounding
        // alone.
        const double out = outward.dot(moved) - kCoincident, distance = -outward.dot(vertex.p - a);
        if (out > 0)
          largest = std::max(largest, distance > 0 ? out / distance : std::numeric_limits<double>::infinity());
      }
    }
  }
  return largest;
}

double relative_tilt(const PolygonSet& cross_section, const ParaxialBundle& bundle) {
  double largest = 0;
  for (const MovingPolygon& polygon : cross_section.polygons()) {
    for (const MovingVertex& vertex : polygon)
      largest = std::max(largest, bundle.direction_map.at(vertex.p).norm() / kMaxTilt);
  }
  return largest;
}

}  // namespace

ArrivingRays arriving_rays(const BeamSegment& segment, const CandidatePanel& candidate) {
  ArrivingRays rays{segment.ray_bundle, segment.curvature_scale};
  if (!segment.has_curved_reflection) return rays;
  rays.chief = chief_ray(candidate);
  const double distance = distance_to(segment, candidate, rays.chief);
  rays.path_slope = segment.source_plane.slope - candidate.projection.plane.slope;
  rays.bundle.propagate(distance);
  // The displacement is nearly proportional to the scale; the repetitions correct for its higher orders.
  constexpr int kRepetitions = 3;
  for (int i = 0; i < kRepetitions; ++i) {
    double excess = relative_displacement(*segment.cross_section, rays);
    if (excess > 1) excess = std::min(excess, relative_to_panel(candidate, rays));
    excess = std::max(excess, relative_tilt(*segment.cross_section, rays.bundle));
    if (excess <= 1) break;
    rays.scale /= excess;
    rays.bundle = leaving_rays(segment, rays.scale);
    rays.bundle.propagate(distance);
  }
  return rays;
}

Vec2 projected(const CurvatureContext& on, const BeamSegment& segment, const Vec3& x) {
  const Vec3 image = segment.image_transform.image(x);
  return {image.dot(on.transmit.h), image.dot(on.transmit.v)};
}

std::array<Vec2, 3> projected(const CurvatureContext& on, const BeamSegment& segment, int facet) {
  const auto& [a, b, c] = on.facets[facet].corner;
  return {projected(on, segment, a), projected(on, segment, b), projected(on, segment, c)};
}

void reflect_rays(const CurvatureContext& on, const BeamSegment& segment, const CandidatePanel& candidate,
                  BeamSegment& next) {
  const int facet = candidate.projection.facet;
  const bool curved = on.surface.curved(facet) != nullptr;
  next.has_curved_reflection = segment.has_curved_reflection || curved;
  next.cross_section = &candidate.illuminated;
  if (!next.has_curved_reflection) return;
  const ArrivingRays rays = arriving_rays(segment, candidate);
  next.ray_bundle = rays.bundle;
  next.curvature_scale = rays.scale;
  if (segment.has_curved_reflection) next.path_m = distance_to(segment, candidate, rays.chief);
  if (!curved) return;
  // Fermat: a reflector higher by s shortens the path by 2 s cos(incidence).
  next.reflector_curvature =
      edge_midpoint_quadratic(Barycentric(projected(on, segment, facet)),
                              edge_sagittas(on, segment, facet, [](double cosine) { return 2 * cosine; }));
  Quadratic added = next.reflector_curvature;
  added *= rays.scale;
  next.ray_bundle.reflect(added);
}

}  // namespace seaglint

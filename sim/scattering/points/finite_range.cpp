// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/points/finite_range.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "sim/scattering/radiation/curved_footprint.h"

namespace seaglint {
namespace {

// Minus the path that the curvature of the wavefront adds at the point p, m: quadratic in p.
double curvature_path(const Footprint& footprint, const BistaticGeometry& geometry, const RadarRange& radar,
                      const Vec2& p) {
  const PathGradient at = phase_gradient(footprint, p, geometry.transmit);
  const auto off_axis = [&](const Vec3& x, const Vec3& r) { return (x - r.dot(x) * r).squaredNorm(); };
  return -(off_axis(radar.origin + at.transmit, geometry.transmit.r) +
           off_axis(radar.origin + at.receive, geometry.receive.r)) /
         (2 * radar.range_m);
}

// Linear function of the projection plane, m.
struct Tangent {
  double value = 0;
  Vec2 slope = Vec2::Zero();

  double at(const Vec2& p) const { return value + slope.dot(p); }
};

// First order of the curvature's path about p; its central differences are exact.
Tangent curvature_tangent(const Footprint& footprint, const BistaticGeometry& geometry, const RadarRange& radar,
                          const Vec2& p) {
  constexpr double kStep = 1;  // m
  const auto path = [&](const Vec2& q) { return curvature_path(footprint, geometry, radar, q); };
  const auto derivative = [&](const Vec2& axis) {
    return (path(p + kStep * axis) - path(p - kStep * axis)) / (2 * kStep);
  };
  const Vec2 slope(derivative(Vec2::UnitX()), derivative(Vec2::UnitY()));
  return {path(p) - slope.dot(p), slope};
}

// The footprint with a linear function added to psi.
Footprint tilted(const Footprint& footprint, const Tangent& tangent) {
  Footprint result = footprint;
  result.psi0 += tangent.value;
  result.w += tangent.slope;
  const Vec2 &w = result.w, &rise = result.plane.slope;
  result.psi_slope = std::sqrt(std::max(0.0, w.squaredNorm() - std::pow(rise.dot(w), 2) / (1 + rise.squaredNorm())));
  if (footprint.curvature) {
    auto curvature = std::make_shared<CurvedFootprint>(*footprint.curvature);
    for (Vec2& at_vertex : curvature->w) at_vertex += tangent.slope;
    for (Vec2& at_vertex : curvature->slope) at_vertex += tangent.slope;
    result.curvature = std::move(curvature);
  }
  return result;
}

// `decompose` appends the points of a footprint for an aspect change, rad.
template <typename Point, typename Decompose>
void decompose_tilted(const Footprint& footprint, const BistaticGeometry& geometry, const RadarRange& radar,
                      const Decompose& decompose, std::vector<Point>& out) {
  const Vec2 middle = centroid(footprint.polygon);
  double extent = 0;
  for (const MovingVertex& vertex : footprint.polygon)
    extent = std::max(extent, footprint.surface_length(vertex.p - middle));
  const Tangent tangent = curvature_tangent(footprint, geometry, radar, middle);
  const std::size_t first = out.size();
  decompose(at_any_slope_rate(tilted(footprint, tangent)), extent / radar.range_m);
  const std::span<Point> points = std::span(out).subspan(first);
  for (Point& point : points) {
    const Vec3 image = point.gradient.transmit - point.gradient.transmit_slide;
    point.psi -= tangent.at({image.dot(geometry.transmit.h), image.dot(geometry.transmit.v)});
  }
  apply_wavefront_curvature(points, geometry, radar);
}

}  // namespace

Footprint at_any_slope_rate(Footprint footprint) {
  footprint.psi_slope_rate = 2;
  return footprint;
}

void decompose_at_range(const Footprint& footprint, const BistaticGeometry& geometry, const FrequencyBand& band,
                        const RadarRange& radar, std::vector<BandPoint>& out) {
  const auto append = [&](const Footprint& local, double aspect_change_rad) {
    decompose(local, geometry.transmit, band, aspect_change_rad, out);
  };
  decompose_tilted(footprint, geometry, radar, append, out);
}

void decompose_at_range(const Footprint& footprint, const BistaticGeometry& geometry,
                        const DecompositionSettings& settings, const RadarRange& radar,
                        std::vector<PointContribution>& out) {
  const auto append = [&](const Footprint& local, double aspect_change_rad) {
    DecompositionSettings total = settings;
    total.aspect_change_rad += aspect_change_rad;
    decompose(local, geometry.transmit, total, out);
  };
  decompose_tilted(footprint, geometry, radar, append, out);
}

}  // namespace seaglint

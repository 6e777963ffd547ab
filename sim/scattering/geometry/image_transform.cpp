// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/geometry/image_transform.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace seaglint {

MovingLine DepthPlane::moving() const {
  MovingLine line;
  line.value = z0;
  line.gradient = slope;
  line.value_d1 = slope.x() * z0;
  line.value_d2 = slope.y() * z0;
  line.gradient_d1 = Vec2::UnitX() + slope.x() * slope;
  line.gradient_d2 = Vec2::UnitY() + slope.y() * slope;
  return line;
}

DepthPlane depth_plane(const Vec3& n, double offset, const RadarBasis& basis) {
  const double nr = n.dot(basis.r);
  return {offset / nr, Vec2(-n.dot(basis.h) / nr, -n.dot(basis.v) / nr)};
}

PanelMap::PanelMap(const DepthPlane& own, const RadarBasis& receive, const ImageTransform& image_transform,
                   const RadarBasis& transmit)
    : own_(own) {
  const auto in_beam = [&](const Vec3& x) { return Vec3(x.dot(transmit.h), x.dot(transmit.v), x.dot(transmit.r)); };
  origin_ = in_beam(image_transform.image(own.z0 * receive.r));
  first_ = in_beam(image_transform.L * (receive.h + own.slope.x() * receive.r));
  second_ = in_beam(image_transform.L * (receive.v + own.slope.y() * receive.r));
  determinant_ = first_.x() * second_.y() - first_.y() * second_.x();
}

MovingPolygon PanelMap::mapped(const MovingPolygon& polygon) const {
  MovingPolygon image;
  for (const MovingVertex& vertex : polygon) {
    // Point of the vertex on the panel, and its slide over the panel relative to a body-fixed point.
    const double z = own_.at(vertex.p);
    const Vec3 x = origin_ + vertex.p.x() * first_ + vertex.p.y() * second_;
    const auto moved = [&](const Vec2& slide) -> Vec2 { return (slide.x() * first_ + slide.y() * second_).xy(); };
    image.push_back(
        {x.xy(), moved(vertex.d1 + Vec2(z, 0)) - Vec2(x.z(), 0), moved(vertex.d2 + Vec2(0, z)) - Vec2(0, x.z())});
  }
  if (signed_area(image) < 0) std::reverse(image.begin(), image.end());
  return image;
}

Vec2 PanelMap::inverse(const Vec2& p) const {
  const Vec2 d = p - origin_.xy();
  return Vec2(d.x() * second_.y() - d.y() * second_.x(), d.y() * first_.x() - d.x() * first_.y()) / determinant_;
}

namespace {

// Least and greatest coordinate of all vertices along an axis.
std::pair<double, double> range_along(const Vec2& axis, std::span<const MovingPolygon> polygons) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const MovingPolygon& polygon : polygons) {
    for (const MovingVertex& vertex : polygon) {
      const double at = axis.dot(vertex.p);
      low = std::min(low, at);
      high = std::max(high, at);
    }
  }
  return {low, high};
}

}  // namespace

std::array<PolygonSet, 2> halved(const PolygonSet& cross_section, const DepthPlane& source) {
  Vec2 axis = along_longest_side(cross_section.polygons());
  auto [low, high] = range_along(axis, cross_section.polygons());
  const Vec2 across(-axis.y(), axis.x());
  const auto [low_across, high_across] = range_along(across, cross_section.polygons());
  if (high_across - low_across > high - low) {
    axis = across;
    low = low_across;
    high = high_across;
  }
  // A point of the plane at height z moves by -z d_i when the look direction changes by d_i.
  MovingLine line;
  line.gradient = axis;
  line.value = -0.5 * (low + high);
  line.value_d1 = axis.x() * source.z0;
  line.value_d2 = axis.y() * source.z0;
  line.gradient_d1 = axis.x() * source.slope;
  line.gradient_d2 = axis.y() * source.slope;
  std::array<PolygonSet, 2> halves;
  for (const MovingPolygon& polygon : cross_section.polygons()) {
    auto parts = split_by_line(polygon, line);
    for (int i = 0; i < 2; ++i) {
      if (!parts[i].empty()) halves[i].push_back(std::move(parts[i]));
    }
  }
  return halves;
}

}  // namespace seaglint

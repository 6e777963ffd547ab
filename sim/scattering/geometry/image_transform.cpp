// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/geometry/image_transform.h"

#include <algorithm>

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

}  // namespace seaglint

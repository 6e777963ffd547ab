// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beams/image_transform.h"

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

}  // namespace seaglint

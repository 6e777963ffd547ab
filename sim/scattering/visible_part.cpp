// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/visible_part.h"

#include <algorithm>
#include <cmath>

namespace seaglint {

MovingLine depth_between(const ImagePlane& a, const ImagePlane& b) {
  const MovingLine la = a.moving(), lb = b.moving();
  MovingLine line;
  line.value = lb.value - la.value;
  line.gradient = lb.gradient - la.gradient;
  line.value_d1 = lb.value_d1 - la.value_d1;
  line.value_d2 = lb.value_d2 - la.value_d2;
  line.gradient_d1 = lb.gradient_d1 - la.gradient_d1;
  line.gradient_d2 = lb.gradient_d2 - la.gradient_d2;
  return line;
}

MovingPolygon nearer_part(const MovingPolygon& image_b, const ImagePlane& plane_b, int facet_b,
                          const ImagePlane& plane_a, int facet_a) {
  const MovingLine above = depth_between(plane_a, plane_b);
  double lowest = 0, highest = 0;
  for (const Corner& corner : image_b) {
    lowest = std::min(lowest, above.at(corner.p));
    highest = std::max(highest, above.at(corner.p));
  }
  if (highest < kCoincident) return lowest > -kCoincident && facet_b < facet_a ? image_b : MovingPolygon{};
  return lowest >= 0 ? image_b : clip(image_b, above, +1);
}

void cut(std::vector<MovingPolygon>& pieces, const MovingPolygon& hole, double min_area) {
  const Box box = box_of(hole);
  std::vector<MovingPolygon> rest;
  rest.reserve(pieces.size());
  for (MovingPolygon& piece : pieces) {
    if (!overlap(box_of(piece), box) || signed_area(intersect(piece, hole)) <= min_area) {
      rest.push_back(std::move(piece));
    } else {
      subtract(piece, hole, min_area, rest);
    }
  }
  pieces = std::move(rest);
}

MovingPolygon shadow_on(const std::array<Vec3, 3>& triangle, const Vec3& n, double offset, const Mirror& mirrors,
                        const RadarBasis& basis) {
  // The part of the triangle above the plane, a polygon of at most four points.
  std::vector<Vec3> above;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = triangle[i], &b = triangle[(i + 1) % 3];
    const double fa = n.dot(a) - offset, fb = n.dot(b) - offset;
    if (fa >= 0) above.push_back(a);
    if ((fa > 0 && fb < 0) || (fa < 0 && fb > 0)) above.push_back(a + fa / (fa - fb) * (b - a));
  }
  if (above.size() < 3) return {};

  // A point y of the triangle falls on x = y - s r^ with s = (n.y - offset) / n.r^; as r^ turns by e_i, x moves by -s
  // (e_i - r^ n.e_i / n.r^).
  const double nr = n.dot(basis.r);
  MovingPolygon shadow;
  for (const Vec3& y : above) {
    const double s = (n.dot(y) - offset) / nr;
    const Vec3 image = mirrors.image(y - s * basis.r);
    const double z = image.dot(basis.r);
    const auto moved = [&](const Vec3& e) -> Vec3 { return mirrors.L * (-s * (e - basis.r * (n.dot(e) / nr))); };
    const Vec3 x1 = moved(basis.h), x2 = moved(basis.v);
    shadow.push_back({Vec2(image.dot(basis.h), image.dot(basis.v)), Vec2(x1.dot(basis.h) - z, x1.dot(basis.v)),
                      Vec2(x2.dot(basis.h), x2.dot(basis.v) - z)});
  }
  shadow = counter_clockwise(std::move(shadow));
  return signed_area(shadow) > 0 ? shadow : MovingPolygon{};
}

}  // namespace seaglint

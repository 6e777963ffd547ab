// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/geometry/cross_section.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace seaglint {
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

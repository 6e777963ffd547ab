// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/geometry/polygon_set.h"

namespace seaglint {

void PolygonSet::assign(std::span<const MovingPolygon> polygons) {
  clear();
  for (const MovingPolygon& polygon : polygons) push_back(polygon);
}

double PolygonSet::area() const {
  double area = 0;
  for (const MovingPolygon& polygon : polygons_) area += signed_area(polygon);
  return area;
}

bool PolygonSet::subtract_hole(const MovingPolygon& hole, const Box& box, double min_area) {
  left_.clear();
  std::size_t whole = 0;
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    if (overlap(boxes_[i], box) && subtract(polygons_[i], boxes_[i], hole, min_area, left_)) continue;
    if (whole < i) {
      polygons_[whole] = std::move(polygons_[i]);
      boxes_[whole] = boxes_[i];
    }
    ++whole;
  }
  if (whole == polygons_.size()) return false;
  polygons_.resize(whole);
  boxes_.resize(whole);
  for (MovingPolygon& piece : left_) push_back(std::move(piece));
  return true;
}

}  // namespace seaglint

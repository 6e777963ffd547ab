// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Region of the projection plane as convex polygons with their bounding boxes.

#include <span>
#include <utility>
#include <vector>

#include "sim/scattering/geometry/moving_polygon.h"

namespace seaglint {

// clear() keeps the allocated memory.
class PolygonSet {
 public:
  void clear() {
    polygons_.clear();
    boxes_.clear();
  }
  void assign(std::span<const MovingPolygon> polygons);
  void push_back(MovingPolygon polygon) {
    boxes_.push_back(box_of(polygon));
    polygons_.push_back(std::move(polygon));
  }

  bool empty() const { return polygons_.empty(); }
  std::size_t size() const { return polygons_.size(); }
  std::span<const MovingPolygon> polygons() const { return polygons_; }
  std::span<const Box> boxes() const { return boxes_; }
  double area() const;  // m^2

  // Subtracts the hole, with its bounding box, from every polygon and returns true when any changed. Polygons with at
  // most min_area (m^2) in common with it stay unchanged; remainders of at most min_area are dropped.
  bool subtract_hole(const MovingPolygon& hole, const Box& box, double min_area);

 private:
  std::vector<MovingPolygon> polygons_;
  std::vector<Box> boxes_;
  std::vector<MovingPolygon> left_;  // remainders of the polygons that a hole cuts, work memory
};

}  // namespace seaglint

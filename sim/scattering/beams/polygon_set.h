// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A region of the aperture plane as convex pieces, each with its box.

#include <span>
#include <utility>
#include <vector>

#include "sim/scattering/beams/moving_polygon.h"

namespace seaglint {

// Keeps its memory when it is cleared.
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

  // Takes the hole, whose box is given, out of every piece; pieces with no more than min_area in common with it stay as
  // they are, and what is left of the others in pieces of no more is dropped. True when any piece was cut.
  bool subtract_hole(const MovingPolygon& hole, const Box& box, double min_area);

 private:
  std::vector<MovingPolygon> polygons_;
  std::vector<Box> boxes_;
  std::vector<MovingPolygon> left_;  // of the pieces that a hole cuts
};

}  // namespace seaglint

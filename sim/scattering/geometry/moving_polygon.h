// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Convex polygons in the projection plane whose vertices carry their derivative with respect to the look direction.
//
// The plane is spanned by h and v; the look direction changes as r^ -> r^ + d1 h + d2 v. A vertex carries its position
// and its derivatives with respect to d1 and d2. Clipping propagates them: a vertex where two sides intersect moves as
// that intersection does. The vertices of an illuminated region, on shadow boundaries too, therefore give the phase of
// a whole interval to first order.

#include <array>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct MovingVertex {
  Vec2 p = Vec2::Zero();   // m
  Vec2 d1 = Vec2::Zero();  // dp / d d1, m/rad
  Vec2 d2 = Vec2::Zero();  // dp / d d2
};

// Vertices of a convex polygon, counter-clockwise. Up to kInlineVertices are stored without allocation.
class MovingPolygon {
 public:
  static constexpr std::size_t kInlineVertices = 6;

  MovingPolygon() = default;
  explicit MovingPolygon(std::size_t count) { resize(count); }
  MovingPolygon(const MovingPolygon& other) { assign(other); }
  MovingPolygon(MovingPolygon&& other) noexcept { take(other); }
  MovingPolygon& operator=(const MovingPolygon& other) {
    if (this != &other) assign(other);
    return *this;
  }
  MovingPolygon& operator=(MovingPolygon&& other) noexcept {
    if (this != &other) take(other);
    return *this;
  }
  ~MovingPolygon() { release(); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  MovingVertex* begin() { return corners_; }
  MovingVertex* end() { return corners_ + size_; }
  const MovingVertex* begin() const { return corners_; }
  const MovingVertex* end() const { return corners_ + size_; }
  MovingVertex& operator[](std::size_t i) { return corners_[i]; }
  const MovingVertex& operator[](std::size_t i) const { return corners_[i]; }
  const MovingVertex& back() const { return corners_[size_ - 1]; }

  void clear() { size_ = 0; }
  void resize(std::size_t count) {
    reserve(count);
    for (; size_ < count; ++size_) new (corners_ + size_) MovingVertex();
    size_ = count;
  }
  void push_back(const MovingVertex& vertex) {
    if (size_ == capacity_) {
      // `vertex` may belong to this polygon. NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
      const MovingVertex copy = vertex;
      reserve(2 * capacity_);
      new (corners_ + size_++) MovingVertex(copy);
    } else {
      new (corners_ + size_++) MovingVertex(vertex);
    }
  }
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    MovingVertex* larger = std::allocator<MovingVertex>().allocate(count);
    std::uninitialized_copy_n(corners_, size_, larger);
    release();
    corners_ = larger;
    capacity_ = count;
  }

 private:
  static_assert(std::is_trivially_destructible_v<MovingVertex>);

  MovingVertex* in_place() { return reinterpret_cast<MovingVertex*>(place_); }
  void release() {
    if (corners_ != in_place()) std::allocator<MovingVertex>().deallocate(corners_, capacity_);
    corners_ = in_place();
    capacity_ = kInlineVertices;
  }
  void assign(const MovingPolygon& other) {
    size_ = 0;
    reserve(other.size_);
    std::uninitialized_copy_n(other.corners_, other.size_, corners_);
    size_ = other.size_;
  }
  void take(MovingPolygon& other) {
    if (other.corners_ == other.in_place()) {
      // at most kInlineVertices vertices, for which the capacity here always suffices
      std::uninitialized_copy_n(other.corners_, other.size_, corners_);
    } else {
      release();
      corners_ = std::exchange(other.corners_, other.in_place());
      capacity_ = std::exchange(other.capacity_, kInlineVertices);
    }
    size_ = std::exchange(other.size_, 0);
  }

  alignas(MovingVertex) std::byte place_[kInlineVertices * sizeof(MovingVertex)];
  MovingVertex* corners_ = in_place();
  std::size_t size_ = 0, capacity_ = kInlineVertices;
};

// Linear function on the plane, f = value + gradient . p, with the derivatives of both with respect to d1 and d2 at
// fixed p.
struct MovingLine {
  double value = 0;
  Vec2 gradient = Vec2::Zero();
  double value_d1 = 0, value_d2 = 0;
  Vec2 gradient_d1 = Vec2::Zero(), gradient_d2 = Vec2::Zero();

  double at(const Vec2& p) const { return value + gradient.dot(p); }
};

inline double signed_area(const MovingPolygon& polygon) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    twice += cross(polygon[i].p - polygon[0].p, polygon[i + 1].p - polygon[0].p);
  }
  return 0.5 * twice;
}
Vec2 centroid(const MovingPolygon& polygon);  // of the area; mean of the vertices for zero area

// Part of the polygon where line >= 0, or line <= 0 with keep = -1. Vertices with |line| < kLineTolerance are on the
// line (m for a line of unit gradient).
inline constexpr double kLineTolerance = 1e-10;
MovingPolygon clip(const MovingPolygon& polygon, const MovingLine& line, int keep = +1);

// Parts where line >= 0 and where line <= 0, as clip() returns them.
std::array<MovingPolygon, 2> split_by_line(const MovingPolygon& polygon, const MovingLine& line);

struct Box {
  Vec2 lower = Vec2::Zero();
  Vec2 upper = Vec2::Zero();
};
inline Box box_of(const MovingPolygon& polygon) {
  Box box{polygon[0].p, polygon[0].p};
  for (const MovingVertex& c : polygon) {
    box.lower = box.lower.cwiseMin(c.p);
    box.upper = box.upper.cwiseMax(c.p);
  }
  return box;
}
inline bool overlap(const Box& a, const Box& b) {
  return a.lower.x() < b.upper.x() && b.lower.x() < a.upper.x() && a.lower.y() < b.upper.y() &&
         b.lower.y() < a.upper.y();
}

// True when a side of one polygon has the other polygon entirely on or outside it, so that they have no common area.
bool disjoint(const MovingPolygon& a, const MovingPolygon& b);

// Appends the convex pieces of polygon minus hole that are larger than min_area (m^2) and returns true; returns false
// and appends nothing where the common area is at most min_area. `around`: a box that contains the polygon.
bool subtract(const MovingPolygon& polygon, const Box& around, const MovingPolygon& hole, double min_area,
              std::vector<MovingPolygon>& pieces);

// Intersection of a, which the box `around` contains, and b; empty when they have no common area.
MovingPolygon intersect(const MovingPolygon& a, const Box& around, const MovingPolygon& b);
inline MovingPolygon intersect(const MovingPolygon& a, const MovingPolygon& b) { return intersect(a, box_of(a), b); }

// Unit vector along the longest side of all polygons.
Vec2 along_longest_side(std::span<const MovingPolygon> polygons);

// Region of the projection plane as convex polygons with their bounding boxes.

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

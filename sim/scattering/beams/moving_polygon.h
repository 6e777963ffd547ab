// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Convex polygons in the aperture plane whose corners know how they move when the radar's direction turns.
//
// The aperture plane is spanned by h and v; the direction turns as r^ -> r^ + d1 h + d2 v. A corner carries its
// position and its derivatives by d1 and d2, and clipping carries them on: a corner made by two edges moves as their
// intersection does. So the end points of a lit region keep their first-order phase over a whole interval, shadow edges
// included.

#include <array>
#include <memory>
#include <new>
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

// Corners in order: convex, counter-clockwise. Up to kInlineVertices of them need no memory of their own, which is
// nearly always enough and makes polygons cheap to come and go.
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
      const MovingVertex copy = vertex;  // it may be one of ours
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
      // other holds at most kInlineVertices, and so do we at least
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

// A function that is linear on the plane, f = value + gradient . p, with its derivatives by d1 and d2 at fixed p.
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
    const Vec2 a = polygon[i].p - polygon[0].p, b = polygon[i + 1].p - polygon[0].p;
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}
Vec2 centroid(const MovingPolygon& polygon);  // of the area; of the corners when there is no area
MovingPolygon counter_clockwise(MovingPolygon polygon);

// The part of the polygon where line >= 0 (or <= 0 with keep = -1). Corners nearer to the line than kLineTolerance
// count as on it.
inline constexpr double kLineTolerance = 1e-10;
MovingPolygon clip(const MovingPolygon& polygon, const MovingLine& line, int keep = +1);

// Both parts at once, as clip() has them: where line >= 0, and where line <= 0.
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

// True when an edge of one of the polygons has the other wholly outside it or on it: then they have no area in common.
bool disjoint(const MovingPolygon& a, const MovingPolygon& b);

// polygon, which lies in the box, minus hole where they have more than min_area in common: appends convex pieces with
// an area above min_area to pieces. Else false, and nothing is appended.
bool subtract(const MovingPolygon& polygon, const Box& around, const MovingPolygon& hole, double min_area,
              std::vector<MovingPolygon>& pieces);

// The common part of a, which lies in the box, and b; empty when there is none.
MovingPolygon intersect(const MovingPolygon& a, const Box& around, const MovingPolygon& b);
inline MovingPolygon intersect(const MovingPolygon& a, const MovingPolygon& b) { return intersect(a, box_of(a), b); }

}  // namespace seaglint

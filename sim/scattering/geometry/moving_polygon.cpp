// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/geometry/moving_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace seaglint {

namespace {

Vec2 left_of(const Vec2& along) { return {-along.y(), along.x()}; }

// Line through two vertices, positive on its left, with a gradient as long as their distance. Derivatives of that scale
// are left out, because only the zero of the function matters.
MovingLine line_of_edge(const MovingVertex& from, const MovingVertex& to) {
  MovingLine line;
  line.gradient = left_of(to.p - from.p);
  line.value = -line.gradient.dot(from.p);
  line.gradient_d1 = left_of(to.d1 - from.d1);
  line.gradient_d2 = left_of(to.d2 - from.d2);
  line.value_d1 = -line.gradient_d1.dot(from.p) - line.gradient.dot(from.d1);
  line.value_d2 = -line.gradient_d2.dot(from.p) - line.gradient.dot(from.d2);
  return line;
}

MovingLine opposite(const MovingLine& line) {
  return {-line.value, -line.gradient, -line.value_d1, -line.value_d2, -line.gradient_d1, -line.gradient_d2};
}

// Intersection of the side a -> b with the line, whose values fa and fb at a and b have opposite signs.
MovingVertex meet(const MovingVertex& a, const MovingVertex& b, double fa, double fb, const MovingLine& line) {
  const double tau = fa / (fa - fb);
  MovingVertex vertex;
  const Vec2 along = b.p - a.p;
  vertex.p = a.p + tau * along;
  // Derivative of tau from the total derivatives of the line's value at the two moving end points.
  const auto turned = [&](const Vec2& da, const Vec2& db, double value_d, const Vec2& gradient_d) -> Vec2 {
    const double dfa = value_d + gradient_d.dot(a.p) + line.gradient.dot(da);
    const double dfb = value_d + gradient_d.dot(b.p) + line.gradient.dot(db);
    const double dtau = (fa * dfb - fb * dfa) / ((fa - fb) * (fa - fb));
    return da + tau * (db - da) + dtau * along;
  };
  vertex.d1 = turned(a.d1, b.d1, line.value_d1, line.gradient_d1);
  vertex.d2 = turned(a.d2, b.d2, line.value_d2, line.gradient_d2);
  return vertex;
}

// Position of the vertices of a polygon with respect to a line.
enum class Side { kInside, kOutside, kBoth };

// Clips by f >= 0, f(p) the distance inside the line; |f| < on_line, in the same unit, counts as zero. make_line() is
// called only where a side is cut and returns the line in that unit. `kept` and, if given, `cut_off` are set only where
// the line passes through the polygon.
template <typename Distance, typename MakeLine>
Side clip_by(const MovingPolygon& polygon, const Distance& distance, double on_line, const MakeLine& make_line,
             MovingPolygon& kept, MovingPolygon* cut_off = nullptr) {
  constexpr std::size_t kRemembered = 16;  // vertices whose distance is stored
  std::array<double, kRemembered> remembered;
  bool any_inside = false, any_outside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double f = distance(polygon[i].p);
    any_inside |= f >= on_line;
    any_outside |= f <= -on_line;
    if (i < kRemembered) remembered[i] = f;
  }
  if (!any_outside) return any_inside ? Side::kInside : Side::kOutside;  // all vertices on the line: zero area
  if (!any_inside) return Side::kOutside;
  kept.clear();
  if (cut_off) cut_off->clear();
  const MovingLine& line = make_line();
  const auto value = [&](std::size_t i) {
    const double f = i < kRemembered ? remembered[i] : distance(polygon[i].p);
    return std::abs(f) < on_line ? 0.0 : f;
  };
  const MovingVertex* a = &polygon.back();
  double fa = value(polygon.size() - 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const MovingVertex& b = polygon[i];
    const double fb = value(i);
    if ((fa > 0 && fb < 0) || (fa < 0 && fb > 0)) {
      kept.push_back(meet(*a, b, fa, fb, line));
      if (cut_off) cut_off->push_back(kept.back());
    }
    if (fb >= 0) kept.push_back(b);
    if (fb <= 0 && cut_off) cut_off->push_back(b);
    a = &b;
    fa = fb;
  }
  return kept.size() < 3 ? Side::kOutside : Side::kBoth;
}

// Position of a box with respect to a side: kInside to its left, or where the side has no length; kBoth where the
// vertices in the box must be tested one by one.
Side side_of_edge(const Box& box, const MovingVertex& from, const MovingVertex& to) {
  const Vec2 left = left_of(to.p - from.p), steep = left.cwiseAbs();
  const double centre = left.dot(0.5 * (box.lower + box.upper) - from.p);
  const double reach = steep.dot(0.5 * (box.upper - box.lower)) + kLineTolerance * (steep.x() + steep.y());
  if (centre > reach || left.squaredNorm() < kLineTolerance * kLineTolerance) return Side::kInside;
  return centre < -reach ? Side::kOutside : Side::kBoth;
}

// Clips by the left half-plane of a side. The line's gradient is as long as the side, which avoids a division.
Side clip_by_edge(const MovingPolygon& polygon, const MovingVertex& from, const MovingVertex& to, MovingPolygon& kept,
                  MovingPolygon* cut_off = nullptr) {
  const Vec2 left = left_of(to.p - from.p);
  return clip_by(
      polygon, [&](const Vec2& p) { return left.dot(p - from.p); }, kLineTolerance * left.norm(),
      [&] { return line_of_edge(from, to); }, kept, cut_off);
}

}  // namespace

Vec2 centroid(const MovingPolygon& polygon) {
  Vec2 weighted = Vec2::Zero(), mean = Vec2::Zero();
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    mean += (polygon[i].p - polygon[0].p) / static_cast<double>(polygon.size());
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[i].p - polygon[0].p, b = polygon[i + 1].p - polygon[0].p;
    weighted += cross(a, b) * (a + b) / 3;
    area += cross(a, b);
  }
  return polygon[0].p + (std::abs(area) > 1e-16 ? Vec2(weighted / area) : mean);
}

MovingPolygon clip(const MovingPolygon& polygon, const MovingLine& line, int keep) {
  const MovingLine inside = keep > 0 ? line : opposite(line);
  MovingPolygon kept;
  switch (clip_by(
      polygon, [&](const Vec2& p) { return inside.at(p); }, kLineTolerance,
      [&]() -> const MovingLine& { return inside; }, kept)) {
    case Side::kInside: return polygon;
    case Side::kOutside: return {};
    case Side::kBoth: return kept;
  }
  return kept;
}

std::array<MovingPolygon, 2> split_by_line(const MovingPolygon& polygon, const MovingLine& line) {
  MovingPolygon above, below;
  const auto at = [&](const Vec2& p) { return line.at(p); };
  const Side side = clip_by(
      polygon, at, kLineTolerance, [&] { return line; }, above, &below);
  if (side == Side::kInside) return {polygon, {}};
  if (above.empty() && below.empty()) {  // on one side, or all on the line
    if (std::ranges::any_of(polygon, [&](const MovingVertex& c) { return line.at(c.p) <= -kLineTolerance; }))
      below = polygon;
  }
  for (MovingPolygon* half : {&above, &below}) {
    if (half->size() < 3) half->clear();
  }
  return {std::move(above), std::move(below)};
}

bool disjoint(const MovingPolygon& a, const MovingPolygon& b) {
  const auto outside_an_edge = [](const MovingPolygon& edges, const MovingPolygon& corners) {
    const Vec2* from = &edges.back().p;
    for (const MovingVertex& to : edges) {
      const Vec2 along = to.p - *from;
      const double on_line = kLineTolerance * along.norm();
      if (std::all_of(corners.begin(), corners.end(),
                      [&](const MovingVertex& c) { return cross(along, c.p - *from) <= on_line; }))
        return true;
      from = &to.p;
    }
    return false;
  };
  return outside_an_edge(a, b) || outside_an_edge(b, a);
}

bool subtract(const MovingPolygon& polygon, const Box& around, const MovingPolygon& hole, double min_area,
              std::vector<MovingPolygon>& pieces) {
  const std::size_t before = pieces.size();
  MovingPolygon rests[2], outside;  // part inside all sides so far, double-buffered; part outside the current one
  const MovingPolygon* rest = &polygon;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const MovingVertex &from = hole[i], &to = hole[i + 1 == hole.size() ? 0 : i + 1];
    MovingPolygon& next = rests[rest == &rests[0] ? 1 : 0];
    Side side = side_of_edge(around, from, to);
    if (side == Side::kBoth) side = clip_by_edge(*rest, from, to, next, &outside);
    if (side == Side::kInside) continue;
    if (side == Side::kOutside) {
      pieces.resize(before);
      return false;
    }
    if (outside.size() >= 3 && signed_area(outside) > min_area) pieces.push_back(outside);
    rest = &next;
  }
  if (signed_area(*rest) > min_area) return true;
  pieces.resize(before);
  return false;
}

MovingPolygon intersect(const MovingPolygon& a, const Box& around, const MovingPolygon& b) {
  MovingPolygon rests[2];
  const MovingPolygon* rest = &a;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const MovingVertex &from = b[i], &to = b[i + 1 == b.size() ? 0 : i + 1];
    MovingPolygon& next = rests[rest == &rests[0] ? 1 : 0];
    Side side = side_of_edge(around, from, to);
    if (side == Side::kBoth) side = clip_by_edge(*rest, from, to, next);
    if (side == Side::kOutside) return {};
    if (side == Side::kBoth) rest = &next;
  }
  return *rest;
}

Vec2 along_longest_side(std::span<const MovingPolygon> polygons) {
  Vec2 longest = Vec2::UnitX();
  double max = 0;
  for (const MovingPolygon& polygon : polygons) {
    const Vec2* from = &polygon.back().p;
    for (const MovingVertex& to : polygon) {
      const double squared = (to.p - *from).squaredNorm();
      if (squared > max) {
        max = squared;
        longest = to.p - *from;
      }
      from = &to.p;
    }
  }
  return longest.normalized();
}

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

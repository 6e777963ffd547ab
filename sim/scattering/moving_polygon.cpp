// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/moving_polygon.h"

#include <algorithm>
#include <cmath>

namespace seaglint {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Where the edge a -> b meets the line, whose values fa and fb at its ends have opposite signs.
Corner meet(const Corner& a, const Corner& b, double fa, double fb, const MovingLine& line) {
  const double tau = fa / (fa - fb);
  Corner corner;
  const Vec2 along = b.p - a.p;
  corner.p = a.p + tau * along;
  // The derivative of tau from the total derivatives of the line's value at the two moving ends.
  const auto turned = [&](const Vec2& da, const Vec2& db, double value_d, const Vec2& gradient_d) -> Vec2 {
    const double dfa = value_d + gradient_d.dot(a.p) + line.gradient.dot(da);
    const double dfb = value_d + gradient_d.dot(b.p) + line.gradient.dot(db);
    const double dtau = (fa * dfb - fb * dfa) / ((fa - fb) * (fa - fb));
    return da + tau * (db - da) + dtau * along;
  };
  corner.d1 = turned(a.d1, b.d1, line.value_d1, line.gradient_d1);
  corner.d2 = turned(a.d2, b.d2, line.value_d2, line.gradient_d2);
  return corner;
}

void clip_into(const MovingPolygon& polygon, const MovingLine& line, int keep, MovingPolygon& kept) {
  kept.clear();
  kept.reserve(polygon.size() + 1);
  if (polygon.empty()) return;
  const auto value = [&](const Corner& c) {
    const double f = keep * line.at(c.p);
    return std::abs(f) < kOnLine ? 0.0 : f;
  };
  double fa = value(polygon.back());
  const Corner* a = &polygon.back();
  for (const Corner& b : polygon) {
    const double fb = value(b);
    if ((fa > 0 && fb < 0) || (fa < 0 && fb > 0)) kept.push_back(meet(*a, b, keep * fa, keep * fb, line));
    if (fb >= 0) kept.push_back(b);
    a = &b;
    fa = fb;
  }
  if (kept.size() < 3) kept.clear();
}

}  // namespace

double signed_area(const MovingPolygon& polygon) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    twice += cross(polygon[i].p - polygon[0].p, polygon[i + 1].p - polygon[0].p);
  }
  return 0.5 * twice;
}

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

MovingPolygon counter_clockwise(MovingPolygon polygon) {
  if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

MovingLine line_through(const Corner& from, const Corner& to) {
  const auto left = [](const Vec2& t) { return Vec2(-t.y(), t.x()); };
  const Vec2 along = to.p - from.p;
  const double scale = 1 / along.norm();
  MovingLine line;
  line.gradient = scale * left(along);
  line.value = -line.gradient.dot(from.p);
  // The scale may stay fixed: only the zero of the function matters.
  line.gradient_d1 = scale * left(to.d1 - from.d1);
  line.gradient_d2 = scale * left(to.d2 - from.d2);
  line.value_d1 = -line.gradient_d1.dot(from.p) - line.gradient.dot(from.d1);
  line.value_d2 = -line.gradient_d2.dot(from.p) - line.gradient.dot(from.d2);
  return line;
}

MovingPolygon clip(const MovingPolygon& polygon, const MovingLine& line, int keep) {
  MovingPolygon kept;
  clip_into(polygon, line, keep, kept);
  return kept;
}

bool apart(const MovingPolygon& a, const MovingPolygon& b) {
  // Separating axes: all corners of one polygon outside an edge of the other, or on it.
  const auto outside_an_edge = [](const MovingPolygon& edges, const MovingPolygon& corners) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Vec2& from = edges[i].p;
      const Vec2 along = edges[(i + 1) % edges.size()].p - from;
      const double on_line = kOnLine * along.norm();
      if (std::all_of(corners.begin(), corners.end(), [&](const Corner& c) { return cross(along, c.p - from) <= on_line; })) return true;
    }
    return false;
  };
  return outside_an_edge(a, b) || outside_an_edge(b, a);
}

void subtract(const MovingPolygon& polygon, const MovingPolygon& hole, double min_area,
              std::vector<MovingPolygon>& pieces) {
  MovingPolygon rest = polygon;
  for (std::size_t i = 0; i < hole.size() && !rest.empty(); ++i) {
    const Corner& from = hole[i];
    const Corner& to = hole[(i + 1) % hole.size()];
    if ((to.p - from.p).norm() < kOnLine) continue;
    const MovingLine line = line_through(from, to);
    MovingPolygon outside = clip(rest, line, -1);
    if (signed_area(outside) > min_area) pieces.push_back(std::move(outside));
    rest = clip(rest, line, +1);
  }
}

MovingPolygon intersect(const MovingPolygon& a, const MovingPolygon& b) {
  MovingPolygon rest = a, next;
  for (std::size_t i = 0; i < b.size() && !rest.empty(); ++i) {
    const Corner& from = b[i];
    const Corner& to = b[(i + 1) % b.size()];
    if ((to.p - from.p).norm() < kOnLine) continue;
    clip_into(rest, line_through(from, to), +1, next);
    std::swap(rest, next);
  }
  return rest;
}

Box box_of(const MovingPolygon& polygon) {
  Box box{polygon[0].p, polygon[0].p};
  for (const Corner& c : polygon) {
    box.lower = box.lower.cwiseMin(c.p);
    box.upper = box.upper.cwiseMax(c.p);
  }
  return box;
}

bool overlap(const Box& a, const Box& b) {
  return (a.lower.array() < b.upper.array()).all() && (b.lower.array() < a.upper.array()).all();
}

}  // namespace seaglint

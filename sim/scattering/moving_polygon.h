// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Convex polygons in the aperture plane whose corners know how they move when the radar's direction turns.
//
// The aperture plane is spanned by h and v; the direction turns as r^ -> r^ + d1 h + d2 v. A corner carries its
// position and its derivatives by d1 and d2, and clipping carries them on: a corner made by two edges moves as their
// intersection does. So the end points of a lit region keep their first-order phase over a whole interval, shadow edges
// included.

#include <vector>

#include "sim/core/linear.h"

namespace seaglint {

struct Corner {
  Vec2 p = Vec2::Zero();   // m
  Vec2 d1 = Vec2::Zero();  // dp / d d1, m/rad
  Vec2 d2 = Vec2::Zero();  // dp / d d2
};

using MovingPolygon = std::vector<Corner>;  // convex, counter-clockwise

// A function that is linear on the plane, f = value + gradient . p, with its derivatives by d1 and d2 at fixed p.
struct MovingLine {
  double value = 0;
  Vec2 gradient = Vec2::Zero();
  double value_d1 = 0, value_d2 = 0;
  Vec2 gradient_d1 = Vec2::Zero(), gradient_d2 = Vec2::Zero();

  double at(const Vec2& p) const { return value + gradient.dot(p); }
};

double signed_area(const MovingPolygon& polygon);
Vec2 centroid(const MovingPolygon& polygon);  // of the area; of the corners when there is no area
MovingPolygon counter_clockwise(MovingPolygon polygon);

// The line through two corners, scaled to signed distance, positive on the left.
MovingLine line_through(const Corner& from, const Corner& to);

// The part of the polygon where line >= 0 (or <= 0 with keep = -1). Corners nearer to the line than kOnLine count as on
// it.
inline constexpr double kOnLine = 1e-10;
MovingPolygon clip(const MovingPolygon& polygon, const MovingLine& line, int keep = +1);

// True when the polygons have no interior point in common (edges and corners may touch).
bool apart(const MovingPolygon& a, const MovingPolygon& b);

// polygon minus hole: appends convex pieces with an area above min_area to pieces.
void subtract(const MovingPolygon& polygon, const MovingPolygon& hole, double min_area,
              std::vector<MovingPolygon>& pieces);

// The common part; empty when there is none.
MovingPolygon intersect(const MovingPolygon& a, const MovingPolygon& b);

struct Box {
  Vec2 lower = Vec2::Zero();
  Vec2 upper = Vec2::Zero();
};
Box box_of(const MovingPolygon& polygon);
bool overlap(const Box& a, const Box& b);

}  // namespace seaglint

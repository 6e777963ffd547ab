// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/knife_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "sim/core/constants.h"

namespace seaglint {
namespace {

constexpr double kOnRim = 1e-7;     // m, as for edges that bound a lit polygon (edge_light.cpp)
constexpr double kShortest = 1e-4;  // m
// What is followed in full, and from where on not at all: slopes of psi across the rims, where KnifeEdges::fade_by_slope leaves any, and angles of the way from
// rim to rim against the beam, rad, both for Fresnel's form; sines of the angle between the rims, which near their crossing cut no more than lambda d.
constexpr std::array<double, 2> kSlope{0.1, 0.2}, kSteep{0.2, 0.5}, kAskew{0.3, 0.7};

// A rim as the transmitter sees it through the mirrors before.
struct Rim {
  std::size_t screen;
  Vec2 a, b;
  Vec2 inside;  // a point of its panel
  double depth;  // how far that reaches from the rim, m
};

std::vector<Rim> rims_of(const SharpEdges& edges, const Panels& panels, const RadarBasis& transmit, std::span<const Screen> screens) {
  std::vector<Rim> rims;
  for (std::size_t i = 0; i < screens.size(); ++i) {
    const Screen& screen = screens[i];
    const auto image = [&](const Vec3& x) {
      const Vec3 at = screen.mirrors->image(x);
      return Vec2(at.dot(transmit.h), at.dot(transmit.v));
    };
    const std::span<const Vec3> outline = panels.outline(screen.facet);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& x : outline) middle += x / static_cast<double>(outline.size());
    for (const PanelEdge& side : edges.of_panel(screen.facet)) {
      const SharpEdge& edge = edges.edges[side.edge];
      const WedgeFrame* wedge = wedge_lit(edge, side.first, screen.direction);
      if (!wedge || wedge->N <= 1) continue;
      const Vec2 a = image(edge.a), b = image(edge.b), along = (b - a).normalized();
      double depth = 0;
      for (const Vec3& x : outline) depth = std::max(depth, std::abs(along.x() * (image(x) - a).y() - along.y() * (image(x) - a).x()));
      if (depth > kShortest) rims.push_back({i, a, b, image(middle), depth});
    }
  }
  return rims;
}

// Along one side of a lit piece, t from its start and x across into the piece.
struct SideFrame {
  const Corner &from, &to;
  double length;
  Vec2 along, across;

  double t(const Vec2& p) const { return along.dot(p - from.p); }
  double x(const Vec2& p) const { return across.dot(p - from.p); }
  bool holds(const Rim& rim) const { return std::abs(x(rim.a)) <= kOnRim && std::abs(x(rim.b)) <= kOnRim && x(rim.inside) > 0; }
};

// Along a side that the inner one of two rims bounds, where both are.
class Pair {
 public:
  Pair(const SideFrame& side, const Rim& inner, const Rim& outer, std::span<const Screen> screens)
      : side_(side), outer_(outer), first_(screens[std::min(inner.screen, outer.screen)]), second_(screens[std::max(inner.screen, outer.screen)]),
        outer_is_first_(outer.screen < inner.screen), end_{of_corner(side.from), of_corner(side.to)} {
    for (const Rim* rim : {&inner, &outer}) {
      End a = of_rim(*rim, rim->a, screens), b = of_rim(*rim, rim->b, screens);
      if (a.t > b.t) std::swap(a, b);
      if (a.t > end_[0].t) end_[0] = a;
      if (b.t < end_[1].t) end_[1] = b;
    }
  }

  double length() const { return end_[1].t - end_[0].t; }

  // Places on the first and on the second rim, in the aperture, and what the way between them is, m.
  struct Places {
    Vec2 first, second;
    double first_height, apart, distance;
    Vec2 moves;  // of their t as the direction turns by d1 and by d2
  };
  Places at(std::size_t end) const {
    const auto& [t, moves] = end_[end];
    const double share = (t - side_.t(outer_.a)) / (side_.t(outer_.b) - side_.t(outer_.a));
    const Vec2 on_side = side_.from.p + t * side_.along, on_outer = outer_.a + share * (outer_.b - outer_.a);
    const Vec2 &first = outer_is_first_ ? on_outer : on_side, &second = outer_is_first_ ? on_side : on_outer;
    const double height = first_.plane->at(first);
    return {first, second, height, -side_.x(on_outer), height - second_.plane->at(second), moves};
  }

 private:
  struct End {
    double t;
    Vec2 moves;
  };
  End of_corner(const Corner& corner) const { return {side_.t(corner.p), {side_.along.dot(corner.d1), side_.along.dot(corner.d2)}}; }
  // The end of a rim stays where it is in the body and moves by -z d_i in the aperture.
  End of_rim(const Rim& rim, const Vec2& p, std::span<const Screen> screens) const { return {side_.t(p), -screens[rim.screen].plane->at(p) * side_.along}; }

  const SideFrame& side_;
  const Rim& outer_;
  const Screen &first_, &second_;
  bool outer_is_first_;
  std::array<End, 2> end_;
};

}  // namespace

void find_knife_edges(const SharpEdges& edges, const Panels& panels, const RadarBasis& transmit, std::span<const Screen> screens,
                      const Footprint& footprint, std::vector<EdgeFootprint>& out) {
  std::optional<std::vector<Rim>> rims;  // once a side asks for them
  const auto pair = [&](const SideFrame& side, const Rim& inner, const Rim& outer) {
    if (inner.screen == outer.screen || side.x(outer.inside) <= 0.5 * (side.x(outer.a) + side.x(outer.b))) return;
    const Vec2 run = (outer.b - outer.a).normalized();
    const double askew = fading(std::abs(side.across.dot(run)), kAskew), parallel = std::abs(side.along.dot(run));
    if (askew <= 0) return;
    if (side.holds(outer) && outer.screen < inner.screen) return;  // found the other way round
    const Pair both(side, inner, outer, screens);
    if (both.length() < kShortest) return;
    // Lengths are the first rim's, distances from its line.
    const double turned = outer.screen < inner.screen ? parallel : 1.0;
    EdgeFootprint lacking;
    lacking.length = turned * both.length();
    lacking.facet = footprint.facet;
    lacking.part = lacking.part_beyond = footprint.part;
    lacking.bounces = footprint.bounces;
    EdgeFootprint::KnifeEdges knives;
    knives.slope = footprint.w.dot(side.across);
    knives.depth = std::min(inner.depth, outer.depth);
    const std::array<Pair::Places, 2> ends{both.at(0), both.at(1)};
    const double way = ends[0].distance + ends[1].distance;
    if (way < kShortest) return;
    const double weight = askew * fading(std::abs(knives.slope), kSlope) * fading(turned * (ends[0].apart + ends[1].apart) / way, kSteep);
    if (weight <= 0) return;
    for (int i = 0; i < 4; ++i) lacking.pattern.sharp[i] = Complex(0, weight / (2 * kPi)) * footprint.pattern[i];
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& [first, second, height, apart, distance, moves] = ends[end];
      // Rims of neighbours meet.
      if (apart < -kOnRim || distance < -kOnRim) return;
      knives.distance[end] = std::max(distance, 0.0);
      knives.excess[end] = std::hypot(distance, turned * apart) - std::abs(distance);
      lacking.psi[end] = footprint.psi(second) - knives.excess[end];
      // The path is stationary where the ray meets the first rim, not where it meets the facet: how far that place slips there counts.
      const Vec2 slip = footprint.w.dot(side.along) * (moves + footprint.plane.at(second) * side.along);
      PathGradient& gradient = lacking.gradient[end];
      gradient.transmit_slip = slip.x() * transmit.h + slip.y() * transmit.v;
      gradient.transmit = first.x() * transmit.h + first.y() * transmit.v + height * transmit.r + gradient.transmit_slip;
      gradient.receive = phase_gradient(footprint, second, transmit).receive;
    }
    lacking.knife_edges = knives;
    out.push_back(lacking);
  };

  const MovingPolygon& piece = footprint.polygon;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Corner &from = piece[i], &to = piece[i + 1 == piece.size() ? 0 : i + 1];
    const double length = (to.p - from.p).norm();
    if (length < kShortest) continue;
    const Vec2 along = (to.p - from.p) / length;
    const SideFrame side{from, to, length, along, {-along.y(), along.x()}};
    if (std::abs(footprint.w.dot(side.across)) >= kSlope[1]) continue;
    if (!rims) rims = rims_of(edges, panels, transmit, screens);
    for (const Rim& inner : *rims) {
      if (!side.holds(inner)) continue;
      for (const Rim& outer : *rims) pair(side, inner, outer);
    }
  }
}

double bound_of_knife_edges(const EdgeFootprint& footprint, double lowest, double highest) {
  double pattern = 0;
  for (const Complex& element : footprint.pattern.sharp) pattern = std::max(pattern, std::abs(element));
  const EdgeFootprint::KnifeEdges& knives = *footprint.knife_edges;
  const auto [nearest, farthest] = std::minmax(knives.distance[0], knives.distance[1]);
  const double excess = std::min(knives.excess[0], knives.excess[1]);
  // |1 - F(x)| is at most 1 and at most 1 / 2x, and a stretch of running phase answers from its ends.
  const double run = lowest * std::abs(footprint.psi[1] - footprint.psi[0]);
  return pattern * footprint.length * std::sqrt(lowest * farthest / (2 * kPi)) * std::min(1.0, 0.5 / (lowest * excess)) * std::min(1.0, 2 / run) *
         knives.fade_by_slope(lowest, nearest) * knives.fade_by_depth(highest, nearest);
}

}  // namespace seaglint

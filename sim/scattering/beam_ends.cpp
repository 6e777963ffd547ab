// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/beam_ends.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/constants.h"

namespace seaglint {
namespace {

constexpr double kOnRim = 1e-7;     // m, as for edges that bound a lit polygon (edge_light.cpp)
constexpr double kShortest = 1e-4;  // m
// What is followed in full, and from where on not at all: slopes of psi across rims whose ends do not move, where KnifeEdges::fade_by_slope leaves any; angles of the way from
// rim to rim against the beam, rad, for Fresnel's form; sines of the angle between the rims, which near their crossing cut no more than lambda d.
constexpr std::array<double, 2> kSlope{0.1, 0.2}, kSteep{0.2, 0.5}, kAskew{0.3, 0.7};

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

// What one footprint lacks along one of its sides.
class SideEnds {
 public:
  SideEnds(const Footprint& footprint, const SideFrame& side, std::span<const Screen> screens, const RimWays& ways, const RadarBasis& transmit, std::vector<EdgeFootprint>& out)
      : footprint_(footprint), side_(side), screens_(screens), ways_(ways), transmit_(transmit), out_(out), slope_(-footprint.w.dot(side.across)) {}

  // Depth of the last panel, whose outline is given in the aperture, across the side, m.
  void set_depth(std::span<const Vec2> outline) {
    double least = 0, most = 0;
    for (const Vec2& p : outline) {
      least = std::min(least, side_.x(p));
      most = std::max(most, side_.x(p));
    }
    depth_ = most - least;
  }

  // Takes the end off the shadow line that a rim casts on this side, and puts it on the rim when nothing else hides the way from there.
  void move_to_rim(const Rim& rim, bool hidden) {
    const auto [share, seen] = ways_.share(rim, slope_);
    if (share <= 0) return;
    const double a = side_.t(rim.a), b = side_.t(rim.b), length = side_.length;
    const std::array<double, 2> t{std::max(0.0, std::min(a, b)), std::min(length, std::max(a, b))};
    if (t[1] - t[0] < kShortest) return;
    EdgeFootprint on_line = of_footprint(t[1] - t[0]);
    const Vec2 middle = side_.from.p + 0.5 * (t[0] + t[1]) * side_.along;
    set_spread(screens_[rim.screen].plane->at(middle) - footprint_.plane.at(middle), rim.depth, on_line);
    EdgeFootprint on_rim = on_line;
    set_pattern(share, on_line);
    set_pattern(-share, on_rim);
    std::array<Vec2, 2> moves;
    for (std::size_t end = 0; end < 2; ++end) {
      const double s = t[end] / length;
      const Corner corner{side_.from.p + s * (side_.to.p - side_.from.p), side_.from.d1 + s * (side_.to.d1 - side_.from.d1), side_.from.d2 + s * (side_.to.d2 - side_.from.d2)};
      on_line.psi[end] = footprint_.psi(corner.p);
      on_line.gradient[end] = phase_gradient(footprint_, corner, transmit_);
      set_way(ways_.over(rim.screen, corner.p), on_rim, end);
      moves[end] = along_body(Vec2(side_.along.dot(corner.d1), side_.along.dot(corner.d2)), screens_[rim.screen].plane->at(corner.p));
    }
    out_.push_back(on_line);
    if (!seen || hidden) return;
    slip(moves, on_rim);
    out_.push_back(on_rim);
  }

  // What two rims share, of which `inner` bounds this side. True when the outer one hides the way over the inner one to the receiver.
  bool share_between(const Rim& inner, const Rim& outer) {
    if (inner.screen == outer.screen || side_.x(outer.inside) <= 0.5 * (side_.x(outer.a) + side_.x(outer.b))) return false;
    const Vec2 run = (outer.b - outer.a).normalized();
    const double askew = fading(std::abs(side_.across.dot(run)), kAskew), parallel = std::abs(side_.along.dot(run));
    if (askew <= 0) return false;
    if (side_.holds(outer) && outer.screen < inner.screen) return false;  // found the other way round
    const Pair both(side_, inner, outer, screens_);
    if (both.length() < kShortest) return false;
    // Lengths are the first rim's, distances from its line.
    const Rim &first = inner.screen < outer.screen ? inner : outer, &second = inner.screen < outer.screen ? outer : inner;
    const double turned = &first == &outer ? parallel : 1.0;
    const std::array<Pair::Places, 2> ends{both.at(0), both.at(1)};
    const double way = ends[0].distance + ends[1].distance;
    if (way < kShortest) return false;
    // Rims of neighbours meet.
    for (const Pair::Places& end : ends) {
      if (end.apart < -kOnRim || end.distance < -kOnRim) return false;
    }

    EdgeFootprint lacking = of_footprint(turned * both.length());
    EdgeFootprint::KnifeEdges knives;
    knives.slope = slope_;
    set_spread(0.5 * way, first.depth, lacking);
    knives.shadow_within = &first == &inner;
    // Between rims of two mirrors the last facet tells nothing of what either hides.
    const RimWays::Share share = second.screen + 1 == screens_.size() ? ways_.share(first, slope_) : RimWays::Share{};
    knives.moved = share.moved;
    knives.still = (1 - share.moved) * fading(std::abs(slope_), kSlope);
    const Vec2 way_out = ways_.across(side_.across);
    double landed = 0;  // within the second rim, m
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& [on_first, on_second, height, apart, distance, moves] = ends[end];
      knives.distance[end] = std::max(distance, 0.0);
      knives.excess[end] = std::hypot(distance, turned * apart) - std::abs(distance);
      lacking.psi[end] = footprint_.psi(on_second) - knives.excess[end];
      const RimWays::Way over_first = ways_.over(first.screen, on_first);
      const double within = side_.x(ways_.landing(first.screen, on_first)) - side_.x(on_second);
      const Vec2 step(distance, turned * side_.across.dot(on_second - on_first));
      knives.beyond[end] = std::copysign(std::max(step.norm() - step.dot(way_out), 0.0), within);
      landed += within;
      // The path is stationary where the ray meets the first rim, not where it meets the facet: how far that place slips there counts.
      const Vec2 slip = footprint_.w.dot(side_.along) * along_body(moves, footprint_.plane.at(on_second));
      PathGradient& gradient = lacking.gradient[end];
      gradient.transmit_slip = slip.x() * transmit_.h + slip.y() * transmit_.v;
      gradient.transmit = over_first.transmit + gradient.transmit_slip;
      gradient.receive = phase_gradient(footprint_, on_second, transmit_).receive;
    }
    if (!knives.shadow_within && share.seen && landed > 0) put_on_rim(first, ends, askew * share.moved, lacking);
    const double weight = askew * fading(turned * (ends[0].apart + ends[1].apart) / way, kSteep);
    if (weight > 0 && knives.moved + knives.still > 0) {
      for (int i = 0; i < 4; ++i) lacking.pattern.sharp[i] = Complex(0, weight / (2 * kPi)) * footprint_.pattern[i];
      lacking.knife_edges = knives;
      out_.push_back(lacking);
    }
    return knives.shadow_within && share.moved > 0 && landed < 0;
  }

 private:
  EdgeFootprint of_footprint(double length) const {
    EdgeFootprint end;
    end.length = length;
    end.facet = footprint_.facet;
    end.part = end.part_beyond = footprint_.part;
    end.bounces = footprint_.bounces;
    return end;
  }

  void set_spread(double distance, double mirror_depth, EdgeFootprint& end) const {
    const double depth = std::min(mirror_depth, depth_);
    end.spread = 2 * distance / (depth * depth);
  }

  // What Gordon's contour has of the end along this side (phase_integral), with the sign that takes `share` of it off.
  void set_pattern(double share, EdgeFootprint& end) const {
    const Vec2& w = footprint_.w;
    const double factor = share * (w.x() * side_.along.y() - w.y() * side_.along.x()) / (2 * kPi * w.squaredNorm());
    for (int i = 0; i < 4; ++i) end.pattern.sharp[i] = factor * footprint_.pattern[i];
  }

  static void set_way(const RimWays::Way& way, EdgeFootprint& footprint, std::size_t end) {
    footprint.psi[end] = way.psi;
    footprint.gradient[end].transmit = way.transmit;
    footprint.gradient[end].receive = way.receive;
  }

  // How far a place slips along the side in the body, whose points at this height move by -z d_i in the aperture.
  Vec2 along_body(const Vec2& moves, double height) const { return moves + height * side_.along; }

  void slip(const std::array<Vec2, 2>& moves, EdgeFootprint& on_rim) const {
    const double run = (on_rim.psi[1] - on_rim.psi[0]) / on_rim.length;
    for (std::size_t end = 0; end < 2; ++end) {
      PathGradient& gradient = on_rim.gradient[end];
      gradient.transmit_slip = run * (moves[end].x() * transmit_.h + moves[end].y() * transmit_.v);
      gradient.transmit += gradient.transmit_slip;
    }
  }

  // The end of a beam that goes on beyond the facet, whose rim's field lands on it.
  void put_on_rim(const Rim& rim, const std::array<Pair::Places, 2>& ends, double share, const EdgeFootprint& shared) {
    if (share <= 0) return;
    EdgeFootprint on_rim = of_footprint(shared.length);
    on_rim.spread = shared.spread;
    set_pattern(-share, on_rim);
    std::array<Vec2, 2> moves;
    for (std::size_t end = 0; end < 2; ++end) {
      set_way(ways_.over(rim.screen, ends[end].first), on_rim, end);
      moves[end] = along_body(ends[end].moves, ends[end].first_height);
    }
    slip(moves, on_rim);
    out_.push_back(on_rim);
  }

  const Footprint& footprint_;
  const SideFrame& side_;
  std::span<const Screen> screens_;
  const RimWays& ways_;
  const RadarBasis& transmit_;
  std::vector<EdgeFootprint>& out_;
  double slope_;      // of psi, out of the piece
  double depth_ = 0;  // m
};

}  // namespace

void BeamEnds::find(const Footprint& footprint, std::vector<EdgeFootprint>& out) {
  if (!rims_) {
    rims_ = rims_of(edges_, panels_, antennas_.transmit, screens_);
    outline_ = outline_of(panels_, antennas_.transmit, screens_.back());
  }
  std::optional<RimWays> ways;
  const MovingPolygon& piece = footprint.polygon;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Corner &from = piece[i], &to = piece[i + 1 == piece.size() ? 0 : i + 1];
    if ((to.p - from.p).norm() < kShortest) continue;
    const SideFrame side(from, to);
    for (const Rim& inner : *rims_) {
      if (!side.holds(inner)) continue;
      if (!ways) ways.emplace(antennas_, screens_, footprint);
      SideEnds ends(footprint, side, screens_, *ways, antennas_.transmit, out);
      ends.set_depth(outline_);
      bool hidden = false;
      for (const Rim& outer : *rims_) hidden |= ends.share_between(inner, outer);
      if (inner.screen + 1 < screens_.size()) ends.move_to_rim(inner, hidden);
    }
  }
}

double bound_of_beam_end(const EdgeFootprint& footprint, double lowest, double highest) {
  double pattern = 0;
  for (const Complex& element : footprint.pattern.sharp) pattern = std::max(pattern, std::abs(element));
  // A stretch of running phase answers from its ends.
  const double run = lowest * std::abs(footprint.psi[1] - footprint.psi[0]);
  return pattern * footprint.length * std::min(1.0, 2 / run) * (footprint.knife_edges ? footprint.knife_edges->bound(lowest) : 1.0) * footprint.fade_by_spread(highest);
}

}  // namespace seaglint

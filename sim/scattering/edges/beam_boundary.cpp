// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/beam_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/smooth_step.h"

namespace seaglint {
namespace {

constexpr double kShortest = 1e-4;  // m
// What is followed in full, and from where on not at all: slopes of psi across rims whose ends do not move, where
// KnifeEdges::fade_by_slope leaves any; angles of the way from rim to rim against the beam, rad, for Fresnel's form;
// sines of the angle between the rims, which near their crossing cut no more than lambda d.
constexpr std::array<double, 2> kSlope{0.1, 0.2}, kSteep{0.2, 0.5}, kAskew{0.3, 0.7};

// Along a side that the inner one of two rims bounds, where both are.
class Pair {
 public:
  Pair(const SideFrame& side, const Rim& inner, const Rim& outer, std::span<const Screen> screens)
      : side_(side),
        outer_(outer),
        first_(screens[std::min(inner.screen, outer.screen)]),
        second_(screens[std::max(inner.screen, outer.screen)]),
        outer_is_first_(outer.screen < inner.screen),
        end_{of_corner(side.from), of_corner(side.to)} {
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
    double apart, distance;
    Vec2 moves;  // of their t as the direction turns by d1 and by d2
  };
  Places at(std::size_t end) const {
    const auto& [t, moves] = end_[end];
    const double share = (t - side_.t(outer_.a)) / (side_.t(outer_.b) - side_.t(outer_.a));
    const Vec2 on_side = side_.from.p + t * side_.along, on_outer = outer_.a + share * (outer_.b - outer_.a);
    const Vec2 &first = outer_is_first_ ? on_outer : on_side, &second = outer_is_first_ ? on_side : on_outer;
    return {first, second, -side_.x(on_outer), first_.plane->at(first) - second_.plane->at(second), moves};
  }

 private:
  struct End {
    double t;
    Vec2 moves;
  };
  End of_corner(const Corner& corner) const {
    return {side_.t(corner.p), {side_.along.dot(corner.d1), side_.along.dot(corner.d2)}};
  }
  // The end of a rim stays where it is in the body and moves by -z d_i in the aperture.
  End of_rim(const Rim& rim, const Vec2& p, std::span<const Screen> screens) const {
    return {side_.t(p), -screens[rim.screen].plane->at(p) * side_.along};
  }

  const SideFrame& side_;
  const Rim& outer_;
  const Screen &first_, &second_;
  bool outer_is_first_;
  std::array<End, 2> end_;
};

// What one footprint lacks along one of its sides; the outline of its panel is given in the aperture.
class SideEnds {
 public:
  SideEnds(const SideFrame& side, const RimWays& ways, std::span<const Vec2> outline, std::vector<EdgeFootprint>& out)
      : footprint_(ways.footprint()),
        side_(side),
        screens_(ways.screens()),
        ways_(ways),
        transmit_(ways.aperture()),
        out_(out),
        slope_(-footprint_.w.dot(side.across)),
        depth_(depth_across(side, outline)) {}

  // Takes the end off the shadow line that a rim casts on this side, and puts it on the rim when nothing else hides the
  // way from there.
  void move_to_rim(const Rim& rim, bool hidden) {
    const auto [share, seen] = ways_.share(rim, slope_);
    if (share <= 0) return;
    const double a = side_.t(rim.a), b = side_.t(rim.b), length = side_.length;
    const std::array<double, 2> t{std::max(0.0, std::min(a, b)), std::min(length, std::max(a, b))};
    if (t[1] - t[0] < kShortest) return;
    EdgeFootprint on_line = of_footprint(t[1] - t[0]);
    const ImagePlane& plane = *screens_[rim.screen].plane;
    const Vec2 middle = side_.from.p + 0.5 * (t[0] + t[1]) * side_.along;
    set_spread(plane.at(middle) - footprint_.plane.at(middle), rim.depth, on_line);
    set_pattern(share, rim, on_line);
    std::array<Vec2, 2> places, moves;
    for (std::size_t end = 0; end < 2; ++end) {
      const double s = t[end] / length;
      const Corner corner{side_.from.p + s * (side_.to.p - side_.from.p),
                          side_.from.d1 + s * (side_.to.d1 - side_.from.d1),
                          side_.from.d2 + s * (side_.to.d2 - side_.from.d2)};
      on_line.psi[end] = footprint_.psi(corner.p);
      on_line.gradient[end] = phase_gradient(footprint_, corner, transmit_);
      places[end] = corner.p;
      moves[end] = {side_.along.dot(corner.d1), side_.along.dot(corner.d2)};
    }
    out_.push_back(on_line);
    if (seen && !hidden) put_on_rim(rim, places, moves, share, on_line);
  }

  // What two rims share, of which `inner` bounds this side. True when the outer one hides the way over the inner one to
  // the receiver.
  bool share_between(const Rim& inner, const Rim& outer) {
    if (inner.screen == outer.screen || side_.x(outer.inside) <= 0.5 * (side_.x(outer.a) + side_.x(outer.b)))
      return false;
    const Vec2 run = (outer.b - outer.a).normalized();
    const double askew = fading(std::abs(side_.across.dot(run)), kAskew), parallel = std::abs(side_.along.dot(run));
    if (askew <= 0) return false;
    if (side_.holds(outer) && outer.screen < inner.screen) return false;  // found the other way round
    const Pair both(side_, inner, outer, screens_);
    if (both.length() < kShortest) return false;
    // Lengths are the first rim's, distances from its line.
    const Rim &first = inner.screen < outer.screen ? inner : outer,
              &second = inner.screen < outer.screen ? outer : inner;
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
    std::array<double, 2> within{};  // how far within the second rim the way over the first one lands, m
    for (std::size_t end = 0; end < 2; ++end) {
      const auto& [on_first, on_second, apart, distance, moves] = ends[end];
      knives.distance[end] = std::max(distance, 0.0);
      knives.excess[end] = std::hypot(distance, turned * apart) - std::abs(distance);
      lacking.psi[end] = footprint_.psi(on_second) - knives.excess[end];
      const RimWays::Way over_first = ways_.over(first.screen, on_first);
      within[end] = side_.x(ways_.landing(first.screen, on_first)) - side_.x(on_second);
      const Vec2 step(distance, turned * side_.across.dot(on_second - on_first));
      knives.beyond[end] = std::max(step.norm() - step.dot(way_out), 0.0);
      // The path is stationary where the ray meets the first rim, not where it meets the facet: how far that place
      // slips there counts.
      const Vec2 slip = footprint_.w.dot(side_.along) * along_body(moves, footprint_.plane.at(on_second));
      PathGradient& gradient = lacking.gradient[end];
      gradient.transmit_slip = slip.x() * transmit_.h + slip.y() * transmit_.v;
      gradient.transmit = over_first.transmit + gradient.transmit_slip;
      gradient.receive = phase_gradient(footprint_, on_second, transmit_).receive;
    }
    // Where both rims meet the sign is that of the rest of the stretch.
    const double landed = within[0] + within[1];
    for (std::size_t end = 0; end < 2; ++end)
      knives.beyond[end] = std::copysign(knives.beyond[end], std::abs(within[end]) < kOnRim ? landed : within[end]);
    if (!knives.shadow_within && share.seen && landed > 0)
      put_on_rim(first, {ends[0].first, ends[1].first}, {ends[0].moves, ends[1].moves}, askew * share.moved, lacking);
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

  // What physical optics has of the end along this side, with the sign that takes `share` of it off: by the divergence
  // theorem with F = e e^{jk w.p} / (jk w.e), e as the rim's face runs away from it. So every point of the rim has the
  // end of the strip that it bounds, as in ends_of_beam(), and the phase may run along the side; Gordon's e = w
  // (phase_integral) would leave it some of the ends of other sides.
  void set_pattern(double share, const Rim& rim, EdgeFootprint& end) const {
    const Vec2& e = rim.away;
    const double across = e.x() * side_.along.y() - e.y() * side_.along.x(), slope = footprint_.w.dot(e) / across;
    if (!(std::abs(slope) > kFlat[0])) return;  // neither infinite nor, of a face seen along its rim, undefined
    const double factor = share * (1 - fading(std::abs(slope), kFlat)) / (2 * kPi * slope);
    for (int i = 0; i < 4; ++i) end.pattern.sharp[i] = factor * footprint_.pattern[i];
  }

  // How far a place slips along the side in the body, whose points at this height move by -z d_i in the aperture.
  Vec2 along_body(const Vec2& moves, double height) const { return moves + height * side_.along; }

  // The end on the rim of a mirror, `moves` how its places move along the side as the direction turns; as long and with
  // as much spread as another one.
  void put_on_rim(const Rim& rim, const std::array<Vec2, 2>& places, const std::array<Vec2, 2>& moves, double share,
                  const EdgeFootprint& other) {
    if (share <= 0) return;
    EdgeFootprint on_rim = of_footprint(other.length);
    on_rim.spread = other.spread;
    set_pattern(-share, rim, on_rim);
    std::array<RimWays::Way, 2> way{ways_.over(rim.screen, places[0]), ways_.over(rim.screen, places[1])};
    const double run = (way[1].psi - way[0].psi) / on_rim.length;
    for (std::size_t end = 0; end < 2; ++end) {
      const Vec2 slip = run * along_body(moves[end], screens_[rim.screen].plane->at(places[end]));
      PathGradient& gradient = on_rim.gradient[end];
      on_rim.psi[end] = way[end].psi;
      gradient.transmit_slip = slip.x() * transmit_.h + slip.y() * transmit_.v;
      gradient.transmit = way[end].transmit + gradient.transmit_slip;
      gradient.receive = way[end].receive;
    }
    out_.push_back(on_rim);
  }

  // Depth of the panel across the side, m.
  static double depth_across(const SideFrame& side, std::span<const Vec2> outline) {
    const auto [least, most] =
        std::ranges::minmax(outline | std::views::transform([&](const Vec2& p) { return side.x(p); }));
    return most - least;
  }

  const Footprint& footprint_;
  const SideFrame& side_;
  std::span<const Screen> screens_;
  const RimWays& ways_;
  const RadarBasis& transmit_;
  std::vector<EdgeFootprint>& out_;
  double slope_;  // of psi, out of the piece
  double depth_;  // of the last panel, m
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
      SideEnds ends(side, *ways, outline_, out);
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
  return pattern * footprint.length * std::min(1.0, 2 / run) *
         (footprint.knife_edges ? footprint.knife_edges->bound(lowest) : 1.0) * footprint.fade_by_spread(highest);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/wall_penumbra.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/edges/reflected_edge.h"

namespace seaglint {
namespace {

// Sine of the angle over the face up to which a wave is followed: 37 to 64 deg.
constexpr std::array<double, 2> kGrazes{0.6, 0.9};
// k l s^2 up to which all is one amplitude with its change; beyond, where that is small, ways with phases of their own.
constexpr double kOneAmplitude = 9;
// Phase of the change per sine: 0.1 rad where a trace serves 1e-3 rad.
constexpr double kChangePhase = 100;
// Cosine between the wave's way on the face and the wall's normal below which it runs along the wall.
constexpr std::array<double, 2> kAlongWall{0.1, 0.3};
// Height of the image's shadow line on the wall, in those of the wall, from which on the wall's image of the rim is not
// seen.
constexpr std::array<double, 2> kPastTop{0.6, 1};

// Rim and foot this near to each other meet.
constexpr double kInCorner = 1e-7;  // m

// hh, hv, vh, vv
using Pattern = std::array<double, 4>;

// What a wall returns per area and -jk / 2 pi of a wave along k_hat with fields E_h, E_v.
Pattern of_wall(const Vec3& n, const RadarBasis& antenna, const Vec3& k_hat, const Vec3& E_h, const Vec3& E_v) {
  const Vec3 J_h = n.cross(k_hat.cross(E_h)), J_v = n.cross(k_hat.cross(E_v));
  return {antenna.h.dot(J_h), antenna.h.dot(J_v), antenna.v.dot(J_h), antenna.v.dot(J_v)};
}

}  // namespace

void append_wall_penumbra(const WallBehindRim& wall, const RadarBasis& antenna, const EdgeFootprint& foot_echo,
                          double k, double faintest_m, std::vector<EdgeFootprint>& footprints) {
  const auto& [rim, along, n, wall_normal, height, image_share, foot, shown] = wall;
  const Vec3& r = antenna.r;
  const double s = n.dot(r), c = std::sqrt(1 - s * s);
  const Vec3 back = (r - s * n).normalized();  // on the face, from the wall to the rim
  const double grazes = fading(std::abs(s), kGrazes), faces = 1 - fading(wall_normal.dot(back), kAlongWall),
               length = (foot[1] - foot[0]).norm();
  const double across = back.cross(along).dot(n);
  if (grazes * faces <= 0 || across == 0) return;
  std::array<double, 2> l;
  for (int end = 0; end < 2; ++end) {
    const double way = (rim - foot[end]).cross(along).dot(n) / across;
    if (way < -kInCorner) return;
    l[end] = std::max(way, 0.0);  // rim and foot may meet
  }
  const double way = 0.5 * (l[0] + l[1]);
  // How far along the stretch an end moves as the direction turns about the face's normal, m/rad, and how the way to
  // the rim lengthens.
  const Vec3 run = (foot[1] - foot[0]) / length, turn = n.cross(back) / c;
  const double slips = -1 / turn.dot(c * run), lengthens = back.dot(along) / across;

  // Of the wave, and of its image in the face: soft and hard are half of their difference and of their sum.
  const auto image = [&](const Vec3& x) { return mirrored(x, n); };
  const Pattern direct = of_wall(wall_normal, antenna, -r, antenna.h, antenna.v),
                by_face = of_wall(wall_normal, antenna, image(-r), -image(antenna.h), -image(antenna.v));
  Pattern soft, hard;
  for (int i = 0; i < 4; ++i) {
    soft[i] = 0.5 * (direct[i] - by_face[i]);
    hard[i] = 0.5 * (direct[i] + by_face[i]);
  }

  // With the sine of the angle over the face psi changes by `rise` m; a fall of the phase lengthens with the way.
  const auto append = [&](const Pattern& pattern, const WallRange& range, double rise, double slope, double loudest) {
    EdgeFootprint footprint = foot_echo;
    footprint.length = length;
    footprint.spread = 2 * way / (height * height);
    footprint.wall = range;
    for (int i = 0; i < 4; ++i) footprint.pattern.sharp[i] = pattern[i];
    for (int end = 0; end < 2; ++end) {
      footprint.psi[end] = 2 * r.dot(foot[end]) - range.fall * l[end];
      footprint.gradient[end] = {};
      footprint.gradient[end].transmit = footprint.gradient[end].receive =
          foot[end] + 0.5 * (rise - l[end] * slope) * n - 0.5 * l[end] * range.fall * lengthens * turn;
    }
    const double rate = (footprint.psi[1] - footprint.psi[0]) / length;
    for (int end = 0; end < 2; ++end) {
      if (!shown[end]) continue;
      footprint.gradient[end].transmit_slip = rate * slips * l[end] * turn;
      footprint.gradient[end].transmit += footprint.gradient[end].transmit_slip;
    }
    const double most = std::abs(*std::ranges::max_element(pattern, {}, [](double x) { return std::abs(x); }));
    const double extent = length / std::max(0.5 * k * std::abs(footprint.psi[1] - footprint.psi[0]), 1.0);
    if (most * loudest * extent >= faintest_m) footprints.push_back(footprint);
  };

  // What reflected_edge.h and edge waves by walls leave to this.
  const double ahead = 1 - before_the_beam(1 - 2 * s * s), share = grazes * faces;
  const double past_top = s > 0 ? fading(way * s / c / height, kPastTop) : 1,
               by_rim = (1 - grazing_share(s)) * past_top;
  // What the wall's image, which ends at the line, radiates already.
  const double by_image = image_share * past_top;
  const double at_end = 1 / (4 * kPi * std::abs(s)),
               by_way = std::min(at_end, std::sqrt(k * std::max(l[0], l[1]) / kPi) / (2 * kPi));
  const double at_foot = s > 0 ? share * (by_rim + by_image) : 0, at_line = s > 0 ? -share * by_image : share;
  WallRange range;
  range.l = l;
  range.sine = s;
  if (k * std::max(l[0], l[1]) * s * s < kOneAmplitude) {
    range.change_m = kChangePhase / k;
    for (const bool is_soft : {false, true}) {
      range.soft = is_soft;
      range.foot = at_foot;
      range.line = at_line;
      range.from_rim = share * (is_soft ? 1 : ahead);
      range.part = WallRange::Part::kLessChange;
      append(is_soft ? soft : hard, range, 0, 0, 4 * by_way);
      range.part = WallRange::Part::kChange;
      append(is_soft ? soft : hard, range, range.change_m, 0, 4 * by_way);
    }
    return;
  }
  range.from_rim = 0;
  range.foot = at_foot;
  range.line = 0;
  append(direct, range, 0, 0, at_end);
  range.foot = 0;
  range.line = at_line;
  range.fall = 2 * s * s / c;
  append(direct, range, 0, (4 * s + 2 * s * s * s / (c * c)) / c, at_end);
  range.line = 0;
  range.fall = 2 * (1 - c);
  for (const bool is_soft : {false, true}) {
    range.soft = is_soft;
    range.from_rim = share * (is_soft ? 1 : ahead);
    append(is_soft ? soft : hard, range, 0, 2 * s / c, by_way);
  }
}

}  // namespace seaglint

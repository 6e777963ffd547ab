// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/wall_penumbra.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {
namespace {

// k l s^2 below which all terms form one amplitude with its derivative; above, where they are small, each has its own
// phase.
constexpr double kMergedLimit = 9;
// Phase of the derivative term per unit of sine: 0.1 rad for an aspect change of 1e-3 rad.
constexpr double kChangePhase = 100;
// hh, hv, vh, vv
using ElementPattern = std::array<double, 4>;

// Response of a wall per area and -jk / 2 pi to a wave along k_hat with fields E_h, E_v.
ElementPattern wall_pattern(const Vec3& n, const RadarBasis& antenna, const Vec3& k_hat, const Vec3& E_h,
                            const Vec3& E_v) {
  const Vec3 J_h = n.cross(k_hat.cross(E_h)), J_v = n.cross(k_hat.cross(E_v));
  return {antenna.h.dot(J_h), antenna.h.dot(J_v), antenna.v.dot(J_h), antenna.v.dot(J_v)};
}

}  // namespace

void append_wall_penumbra(const WallBehindEdge& wall, const RadarBasis& antenna, const ContributionSource& source,
                          const MultipleDiffractionLimits& limits, std::vector<Contribution>& contributions) {
  const double k = limits.k;
  const Vec3 &along = wall.edge_direction, &n = wall.face_normal;
  const std::array<Vec3, 2>& foot = wall.foot;
  const double height = wall.height;
  const Vec3& r = antenna.r;
  const double s = n.dot(r), c = std::sqrt(1 - s * s);
  const Vec3 back = (r - s * n).normalized();  // on the face, from the wall to the edge
  const double weight = smooth_taper(std::abs(s), kPenumbraAngleWindow), length = (foot[1] - foot[0]).norm();
  const double across = back.cross(along).dot(n);
  if (weight <= 0 || wall.wall_normal.dot(back) <= 0 || across == 0) return;
  std::array<double, 2> l;
  for (int end = 0; end < 2; ++end) {
    const double distance = (wall.edge_point - foot[end]).cross(along).dot(n) / across;
    if (distance < -kCoincident) return;
    l[end] = std::max(distance, 0.0);  // edge and foot may meet
  }
  const double mean_distance = 0.5 * (l[0] + l[1]);
  // Slide of an end along the interval as the look direction rotates about the face's normal, m/rad, and the change of
  // the distance to the edge.
  const Vec3 run = (foot[1] - foot[0]) / length, turn = n.cross(back) / c;
  const double slides = -1 / turn.dot(c * run), lengthens = back.dot(along) / across;

  // For the direct wave and its image in the face: soft and hard are half of their difference and of their sum.
  const auto image = [&](const Vec3& x) { return reflect_direction(x, n); };
  const ElementPattern direct = wall_pattern(wall.wall_normal, antenna, -r, antenna.h, antenna.v),
                       by_face =
                           wall_pattern(wall.wall_normal, antenna, image(-r), -image(antenna.h), -image(antenna.v));
  ElementPattern soft, hard;
  for (int i = 0; i < 4; ++i) {
    soft[i] = 0.5 * (direct[i] - by_face[i]);
    hard[i] = 0.5 * (direct[i] + by_face[i]);
  }

  // `rise`: d psi / d sine of the grazing angle, m; a phase delay grows with the distance l.
  const auto append = [&](const ElementPattern& pattern, const WallPenumbraTerm& range, double rise, double slope,
                          double max_amplitude) {
    EdgeInterval interval;
    interval.length = length;
    interval.fresnel_wavenumber = 2 * mean_distance / (height * height);
    interval.amplitude = range;
    ScatteringMatrix value;
    for (int i = 0; i < 4; ++i) value[i] = pattern[i];
    for (int end = 0; end < 2; ++end) {
      interval.psi[end] = 2 * r.dot(foot[end]) - range.psi_decrement * l[end];
      interval.gradient[end] = {};
      interval.gradient[end].transmit = interval.gradient[end].receive =
          foot[end] + 0.5 * (rise - l[end] * slope) * n - 0.5 * l[end] * range.psi_decrement * lengthens * turn;
    }
    const double rate = (interval.psi[1] - interval.psi[0]) / length;
    for (int end = 0; end < 2; ++end) {
      if (!wall.ends_follow_edge[end]) continue;
      interval.gradient[end].transmit_slide = rate * slides * l[end] * turn;
      interval.gradient[end].transmit += interval.gradient[end].transmit_slide;
    }
    const double max = std::abs(*std::ranges::max_element(pattern, {}, [](double x) { return std::abs(x); }));
    const double extent = length / std::max(0.5 * k * std::abs(interval.psi[1] - interval.psi[0]), 1.0);
    if (max * max_amplitude * extent >= limits.min_amplitude_m) contributions.push_back({{value}, source, interval});
  };

  const PenumbraWeights weights = penumbra_weights(s);
  const double ahead = weights.edge_path;
  // Already radiated by the wall's image, which ends at the line.
  const double by_image = wall.image_weight;
  const double at_end = 1 / (4 * kPi * std::abs(s)),
               by_path = std::min(at_end, std::sqrt(k * std::max(l[0], l[1]) / kPi) / (2 * kPi));
  const double at_foot = s > 0 ? weight * (weights.foot + by_image) : 0, at_line = s > 0 ? -weight * by_image : weight;
  WallPenumbraTerm range;
  range.l = l;
  range.sine = s;
  if (k * std::max(l[0], l[1]) * s * s < kMergedLimit) {
    range.derivative_scale_m = kChangePhase / k;
    for (const bool is_soft : {false, true}) {
      range.soft = is_soft;
      range.foot_weight = at_foot;
      range.shadow_line_weight = at_line;
      range.edge_path_weight = weight * (is_soft ? 1 : ahead);
      range.part = WallPenumbraTerm::Part::kValue;
      append(is_soft ? soft : hard, range, 0, 0, 4 * by_path);
      range.part = WallPenumbraTerm::Part::kDerivative;
      append(is_soft ? soft : hard, range, range.derivative_scale_m, 0, 4 * by_path);
    }
    return;
  }
  range.edge_path_weight = 0;
  range.foot_weight = at_foot;
  range.shadow_line_weight = 0;
  append(direct, range, 0, 0, at_end);
  range.foot_weight = 0;
  range.shadow_line_weight = at_line;
  range.psi_decrement = 2 * s * s / c;
  append(direct, range, 0, (4 * s + 2 * s * s * s / (c * c)) / c, at_end);
  range.shadow_line_weight = 0;
  range.psi_decrement = 2 * (1 - c);
  for (const bool is_soft : {false, true}) {
    range.soft = is_soft;
    range.edge_path_weight = weight * (is_soft ? 1 : ahead);
    append(is_soft ? soft : hard, range, 0, 2 * s / c, by_path);
  }
}

}  // namespace seaglint

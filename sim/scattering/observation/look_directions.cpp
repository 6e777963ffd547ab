// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/look_directions.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/rotation.h"

namespace seaglint {

namespace {

RadarBasis turned_to(const RadarBasis& basis, const Vec3& r) {
  const Mat3 turn = rotation_between(basis.r, r).matrix();
  return {r, turn * basis.h, turn * basis.v};
}

}  // namespace

double LineOfSight::path_advance(const PropagationPath& path, const Vec3& x, double range_m) const {
  const Vec3 &there = of(path.outbound_via_sea).r, &back = of(path.return_via_sea).r;
  if (range_m <= 0) return (there + back).dot(x);
  double sum = 0;
  // R - |R r - x|, free of cancellation.
  for (const Vec3& r : {there, back})
    sum += (2 * r.dot(x) - x.squaredNorm() / range_m) / (1 + (r - x / range_m).norm());
  return sum;
}

LineOfSight line_of_sight_at(const IntervalSampling& sampling, const Vec3& r_hat, double time_s) {
  RadarBasis radar = radar_basis(r_hat);
  if (!sampling.line_of_sight_rate.isZero(0)) {
    const Vec3 now = (r_hat + (time_s - sampling.pulse_time_s.front()) * sampling.line_of_sight_rate).normalized();
    radar = turned_to(radar, now);
  }
  return {radar, image_basis(radar)};
}

LineOfSight line_of_sight_from(const LineOfSight& origin, const Vec3& x, double range_m) {
  if (range_m <= 0) return origin;
  const auto seen = [&](const RadarBasis& basis) { return turned_to(basis, (basis.r - x / range_m).normalized()); };
  return {seen(origin.radar), seen(origin.image)};
}

namespace {

// Changes below this, rad, count as no motion: 1e-8 rad of phase at the ends of a 144 m ship at 16 GHz.
constexpr double kAtRest = 1e-12;

// Difference of both look directions, without the second-order component along them.
struct Difference {
  Vec3 transmit, receive;

  double dot(const LookDirectionTangent& track) const {
    return transmit.dot(track.transmit) + receive.dot(track.receive);
  }
  double norm() const { return std::sqrt(transmit.squaredNorm() + receive.squaredNorm()); }
  Difference without(const LookDirectionTangent& track) const {
    const double along = dot(track);
    return {transmit - along * track.transmit, receive - along * track.receive};
  }
  LookDirectionTangent unit() const { return {transmit / norm(), receive / norm()}; }
};

Vec3 across(const Vec3& r, const Vec3& d) { return d - r * r.dot(d); }

// A unit vector normal to r, for a body at rest.
Vec3 any_across(const Vec3& r) {
  return (std::abs(r.z()) < 0.9 ? Vec3(Vec3::UnitZ().cross(r)) : Vec3(Vec3::UnitX().cross(r))).normalized();
}

}  // namespace

LookDirectionPath look_direction_path(std::span<const Vec3> transmit, std::span<const Vec3> receive,
                                      const Vec3& transmit_at, const Vec3& receive_at) {
  const auto difference = [&](const Vec3& t, const Vec3& r) {
    return Difference{across(transmit_at, t), across(receive_at, r)};
  };
  LookDirectionPath path;
  const Difference chord = difference(transmit.back() - transmit.front(), receive.back() - receive.front());
  path.along_track =
      chord.norm() > kAtRest ? chord.unit() : LookDirectionTangent{any_across(transmit_at), Vec3::Zero()};
  Difference farthest{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t n = 0; n < transmit.size(); ++n) {
    const Difference beside = difference(transmit[n] - transmit_at, receive[n] - receive_at).without(path.along_track);
    if (beside.norm() > farthest.norm()) farthest = beside;
  }
  path.cross_track = farthest.norm() > kAtRest ? farthest.unit() : LookDirectionTangent{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t n = 0; n < transmit.size(); ++n) {
    const Difference here = difference(transmit[n] - transmit_at, receive[n] - receive_at);
    path.s.push_back(here.dot(path.along_track));
    path.q.push_back(here.dot(path.cross_track));
    path.s_limit = std::max(path.s_limit, std::abs(path.s.back()));
    path.q_limit = std::max(path.q_limit, std::abs(path.q.back()));
    path.max_change = std::max({path.max_change, here.transmit.norm(), here.receive.norm()});
  }
  return path;
}

}  // namespace seaglint

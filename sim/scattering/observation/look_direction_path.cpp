// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/look_direction_path.h"

#include <algorithm>
#include <cmath>

namespace seaglint {
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

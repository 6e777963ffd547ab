// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/trace_plan.h"

#include <algorithm>
#include <cmath>

namespace seaglint {
namespace {

// Polarisation basis of the world frame in body axes.
RadarBasis body_basis(const RadarBasis& world, const Pose& pose) {
  const Mat3 R_BT = pose.R.transpose();
  return {R_BT * world.r, R_BT * world.h, R_BT * world.v};
}

double length_of(std::span<const Vec3> points) {
  double length = 0;
  for (std::size_t n = 1; n < points.size(); ++n) length += (points[n] - points[n - 1]).norm();
  return length;
}

}  // namespace

// Look directions to the radar and to its image in the sea at every pulse, body frame.
struct TracePlan::Directions {
  std::vector<Vec3> to_radar, to_image;

  std::span<const Vec3> of(bool by_sea) const { return by_sea ? to_image : to_radar; }
};

TracePlan::TracePlan(const ObservedMotion& motion, std::span<const PropagationPath> paths, const TraceLimits& limits)
    : range_m_(motion.range_m) {
  const IntervalSampling& sampling = motion.sampling;
  const Vec3& r_hat = motion.r_hat;
  const double range_m = motion.range_m;
  const double start = sampling.pulse_time_s.front(), length = sampling.pulse_time_s.back() - start;
  const auto pose_at = [&](double time_s) {
    Pose pose = motion.trajectory.pose(time_s);
    pose.p += pose.R * motion.centre;
    return pose;
  };
  Directions seen;
  for (const double time_s : sampling.pulse_time_s) {
    time_.push_back(length > 0 ? (time_s - start) / length : 0);
    const Pose& pose = poses_.emplace_back(pose_at(time_s));
    const LineOfSight line_of_sight =
        line_of_sight_from(sights_.emplace_back(line_of_sight_at(sampling, r_hat, time_s)), pose.p, range_m);
    seen.to_radar.push_back(pose.R.transpose() * line_of_sight.radar.r);
    seen.to_image.push_back(pose.R.transpose() * line_of_sight.image.r);
  }
  double turn = 0;
  for (const PropagationPath& path : paths) {
    for (const bool by_sea : {path.outbound_via_sea, path.return_via_sea})
      turn = std::max(turn, length_of(seen.of(by_sea)));
  }
  const auto trace_at = [&](double time_s) {
    const Pose pose = pose_at(time_s);
    traces_.push_back(planned(traces_.size(), pose,
                              line_of_sight_from(line_of_sight_at(sampling, r_hat, time_s), pose.p, range_m), seen,
                              paths));
  };
  // Spans are shortened until the cross-track displacement of every path is within its limit. With as many spans as
  // pulses each pulse has a trace of its own.
  spans_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(turn / limits.aspect_change)));
  for (; spans_ < time_.size(); spans_ += (spans_ + 1) / 2) {
    traces_.clear();
    double beside = 0;
    for (std::size_t i = 0; i < spans_; ++i) {
      trace_at(start + length * (static_cast<double>(i) + 0.5) / static_cast<double>(spans_));
      for (const PlannedPath& path : traces_.back().paths) beside = std::max(beside, path.look_path.q_limit);
    }
    if (beside <= limits.cross_track) return;
  }
  traces_.clear();
  for (const double time_s : sampling.pulse_time_s) trace_at(time_s);
}

double TracePlan::interpolation_weight(std::size_t trace, int pulse) const {
  if (spans_ >= time_.size()) return trace == static_cast<std::size_t>(pulse) ? 1 : 0;
  const auto spans = static_cast<double>(spans_), own = static_cast<double>(trace);
  const double place = std::clamp(time_[static_cast<std::size_t>(pulse)] * spans - 0.5, 0.0, spans - 1);
  return std::max(0.0, 1 - std::abs(place - own));
}

PlannedTrace TracePlan::planned(std::size_t trace, const Pose& pose, const LineOfSight& line_of_sight,
                                const Directions& seen, std::span<const PropagationPath> paths) const {
  const int pulses = static_cast<int>(time_.size());
  PlannedTrace plan;
  plan.first = pulses;
  for (int n = 0; n < pulses; ++n) {
    if (interpolation_weight(trace, n) <= 0) continue;
    plan.first = std::min(plan.first, n);
    plan.last = n;
  }
  if (plan.first > plan.last) return plan;
  const RadarBasis radar = body_basis(line_of_sight.radar, pose), image = body_basis(line_of_sight.image, pose);
  for (const PropagationPath& path : paths) {
    const BistaticGeometry antennas = antennas_on(path, radar, image);
    const auto own = [&](bool by_sea) {
      return seen.of(by_sea).subspan(static_cast<std::size_t>(plan.first),
                                     static_cast<std::size_t>(plan.last - plan.first + 1));
    };
    plan.paths.push_back({path, antennas,
                          look_direction_path(own(path.outbound_via_sea), own(path.return_via_sea), antennas.transmit.r,
                                              antennas.receive.r)});
  }
  return plan;
}

}  // namespace seaglint

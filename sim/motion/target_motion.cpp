// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/target_motion.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"
#include "sim/motion/ship/ship.h"
#include "sim/sea/realisation.h"

namespace seaglint {

Vec3 rest_position(const MotionSpec& spec, double x, double y) {
  return {x, y, spec.model == MotionModel::kFloat ? spec.origin_above_waterline_m : 0.0};
}

Trajectory simulate_motion(const Body& body, const Vec3& rest_position, const WaveField& sea, double duration_s,
                           std::uint64_t seed, std::uint64_t index) {
  SEAGLINT_CHECK(duration_s >= 0 && std::isfinite(duration_s), fmt::format("duration {} s", duration_s));
  const double x = rest_position.x();
  const double y = rest_position.y();
  std::vector<MotionSample> samples;
  if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) {
    samples = simulate_ship(*ship, body.spec, sea, x, y, duration_s);
  } else if (const auto* raft = std::get_if<FloatParticulars>(&body.model)) {
    samples = simulate_float(*raft, body.spec, sea, x, y, duration_s, seed, index);
  } else if (const auto* table = std::get_if<RaoTable>(&body.model)) {
    samples = simulate_rao(*table, body.spec, sea, x, y, duration_s);
  } else if (const auto* series = std::get_if<AttitudeSeries>(&body.model)) {
    return trajectory_of(*series, body.spec.series_start_s, duration_s, body.spec.translations, rest_position,
                         body.rotation_centre);
  } else {
    return Trajectory::at_rest(rest_position);
  }
  return Trajectory(0, body.spec.step_s, std::move(samples), rest_position, body.rotation_centre);
}

namespace {

constexpr std::uint64_t kMaxBodies = 65536;  // of a scenario; a line holds up to 1000
constexpr std::uint64_t kIndependentSeas = std::uint64_t{1} << 48;

}  // namespace

Vec3 raft_origin(const TargetSpec& target) {
  const Vec2 centre = layout_centre(target.layout);
  return {centre.x(), centre.y(), 0};
}

bool is_moving_raft(const TargetSpec& target) {
  return is_raft(target.layout) && target.motion.model != MotionModel::kFixed;
}

double rest_height_m(const TargetSpec& target) {
  return is_moving_raft(target) ? target.motion.origin_above_waterline_m : rest_position(target.motion, 0, 0).z();
}

std::vector<Vec3> rest_positions(const TargetSpec& target) {
  std::vector<Vec3> positions;
  const std::vector<double> heights_m = body_heights_m(target.layout);
  for (const Vec2& place : layout_positions(target.layout))
    positions.emplace_back(place.x(), place.y(), rest_height_m(target) + heights_m[positions.size()]);
  return positions;
}

std::uint64_t body_index(std::uint64_t sea_index, std::size_t body) {
  SEAGLINT_CHECK(body < kMaxBodies, fmt::format("body {}", body));
  return sea_index * kMaxBodies + body;
}

std::vector<Trajectory> simulate_target(const TargetMotionRequest& request) {
  const TargetSpec& target = request.target;
  const std::size_t models = request.models.size();
  SEAGLINT_CHECK(models == 1 || models == body_count(target.layout),
                 fmt::format("{} motion models of {} bodies", models, body_count(target.layout)));
  const auto moved = [&](const Vec3& rest, std::size_t i) {
    const Body& body = *request.models[models == 1 ? 0 : i];
    const std::uint64_t index = body_index(request.sea_index, request.first_body + i);
    if (target.motion.waves == WaveSharing::kSameField)
      return simulate_motion(body, rest, request.sea, request.duration_s, request.seed, index);
    const WaveField own_sea = realise_sea(request.state, request.seed, kIndependentSeas + index);
    return simulate_motion(body, rest, own_sea, request.duration_s, request.seed, index);
  };
  const std::vector<Vec3> rests = rest_positions(target);
  const std::vector<double> heights_m = body_heights_m(target.layout), headings = body_headings_rad(target.layout);
  std::vector<Trajectory> trajectories(rests.size());
  if (is_raft(target.layout)) {
    const Vec3 origin = raft_origin(target);
    const Trajectory raft = moved(origin, 0);
    for (std::size_t i = 0; i < rests.size(); ++i)
      trajectories[i] = raft.of_point(rests[i] - origin).turned(headings[i]);
    return trajectories;
  }
  parallel_for(rests.size(), thread_count(request.threads), [&](std::size_t i) {
    const Vec3 above(0, 0, heights_m[i]);
    trajectories[i] = moved(rests[i] - above, i).of_point(above).turned(headings[i]);
  });
  return trajectories;
}

}  // namespace seaglint

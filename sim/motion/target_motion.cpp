// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/target_motion.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
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
    samples = simulate_float({*raft, body.spec, sea, {x, y}, 0, seed, index}, duration_s);
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

namespace {

Vec3 horizontal(double size, double towards_deg) {
  return {size * std::cos(radians(towards_deg)), size * std::sin(radians(towards_deg)), 0};
}

}  // namespace

Vec3 current_mps(const MotionSpec& spec) {
  return spec.drift ? horizontal(spec.drift->current_mps, spec.drift->current_towards_deg) : Vec3::Zero();
}

Vec3 mean_drift_mps(const MotionSpec& spec) {
  if (!spec.drift) return Vec3::Zero();
  return spec.drift->leeway * horizontal(spec.drift->wind_mps, spec.drift->wind_towards_deg) + current_mps(spec);
}

std::vector<Vec3> drift_velocities_mps(const TargetSpec& target, std::uint64_t seed, std::uint64_t sea_index,
                                       std::size_t first_body) {
  std::vector<Vec3> velocities(body_count(target.layout), mean_drift_mps(target.motion));
  if (!target.motion.drift || target.motion.drift->spread_mps == 0) return velocities;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const std::size_t body = is_raft(target.layout) ? first_body : first_body + i;
    Random random({seed, Stream::kDrift, body_index(sea_index, body)});
    const double x = random.normal(), y = random.normal();
    velocities[i] += target.motion.drift->spread_mps * Vec3(x, y, 0);
  }
  return velocities;
}

namespace {

// Moves the bodies of a target, each by itself.
class BodiesInWaves {
 public:
  explicit BodiesInWaves(const TargetMotionRequest& request) : request_(request), target_(request.target) {}

  const Body& body(std::size_t i) const { return *request_.models[request_.models.size() == 1 ? 0 : i]; }
  // The sea of body i, if it has one of its own.
  std::optional<WaveField> own_sea(std::size_t i) const {
    if (target_.motion.waves == WaveSharing::kSameField) return std::nullopt;
    return realise_sea(request_.state, request_.seed, kIndependentSeas + index(i));
  }
  Trajectory free(const Vec3& rest, std::size_t i) const {
    const std::optional<WaveField> own = own_sea(i);
    const WaveField& sea = own ? *own : request_.sea;
    if (!std::holds_alternative<FloatParticulars>(body(i).model) || target_.motion.speed_mps == 0)
      return simulate_motion(body(i), rest, sea, request_.duration_s, request_.seed, index(i));
    return trajectory(simulate_float(float_request(rest, sea, i), request_.duration_s), rest, i);
  }
  // Floats whose neighbours are joined by ropes.
  std::vector<Trajectory> tethered(std::span<const Vec3> rests, double rope_m) const {
    std::vector<std::optional<WaveField>> own;
    for (std::size_t i = 0; i < rests.size(); ++i) own.push_back(own_sea(i));
    std::vector<FloatRequest> line;
    for (std::size_t i = 0; i < rests.size(); ++i)
      line.push_back(float_request(rests[i], own[i] ? *own[i] : request_.sea, i));
    std::vector<std::vector<MotionSample>> samples = simulate_tethered_floats(line, rope_m, request_.duration_s);
    std::vector<Trajectory> trajectories;
    for (std::size_t i = 0; i < rests.size(); ++i)
      trajectories.push_back(trajectory(std::move(samples[i]), rests[i], i));
    return trajectories;
  }

 private:
  std::uint64_t index(std::size_t i) const { return body_index(request_.sea_index, request_.first_body + i); }
  FloatRequest float_request(const Vec3& rest, const WaveField& sea, std::size_t i) const {
    return {std::get<FloatParticulars>(body(i).model),
            body(i).spec,
            sea,
            rest.xy(),
            target_.motion.speed_mps,
            request_.seed,
            index(i)};
  }
  Trajectory trajectory(std::vector<MotionSample> samples, const Vec3& rest, std::size_t i) const {
    return Trajectory(0, body(i).spec.step_s, std::move(samples), rest, body(i).rotation_centre);
  }

  const TargetMotionRequest& request_;
  const TargetSpec& target_;
};

}  // namespace

std::vector<Trajectory> simulate_target(const TargetMotionRequest& request) {
  const TargetSpec& target = request.target;
  const std::size_t models = request.models.size();
  SEAGLINT_CHECK(models == 1 || models == body_count(target.layout),
                 fmt::format("{} motion models of {} bodies", models, body_count(target.layout)));
  const BodiesInWaves motion(request);
  const std::vector<Vec3> rests = rest_positions(target);
  const std::vector<double> heights_m = body_heights_m(target.layout), headings = body_headings_rad(target.layout);
  std::vector<Trajectory> trajectories(rests.size());
  if (is_raft(target.layout)) {
    const Vec3 origin = raft_origin(target);
    const Trajectory raft = motion.free(origin, 0);
    for (std::size_t i = 0; i < rests.size(); ++i)
      trajectories[i] = raft.of_point(rests[i] - origin).turned(headings[i]);
    return trajectories;
  }
  std::vector<Vec3> feet;  // of masts, where the bodies have heights of their own
  for (std::size_t i = 0; i < rests.size(); ++i) feet.push_back(rests[i] - Vec3(0, 0, heights_m[i]));
  if (const std::optional<double> rope_m = rope_length_m(target.layout)) {
    trajectories = motion.tethered(feet, *rope_m);
  } else {
    parallel_for(rests.size(), thread_count(request.threads),
                 [&](std::size_t i) { trajectories[i] = motion.free(feet[i], i); });
  }
  for (std::size_t i = 0; i < rests.size(); ++i)
    trajectories[i] = trajectories[i].of_point(Vec3(0, 0, heights_m[i])).turned(headings[i]);
  return trajectories;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/motion/target_motion.h"
#include "sim/scattering/observation/observation.h"
#include "sim/sea/realisation.h"

namespace seaglint {

namespace {

double interval_length_s(const RadarSpec& radar) { return radar.pulses * radar.pri_us * 1e-6; }

// From t = 0 to the end of a realisation's last interval.
double scene_duration_s(const Scenario& scenario, const SamplePlan& plan) {
  return plan.last_start_s() + interval_length_s(scenario.radar);
}

// Radius, m, about the target's reference point within which the target stays.
double reach_m(const Target& target, double interval_s) {
  double reach = 0;
  for (const PointSpec& point : target.spec.points) {
    const Vec3 position(point.position_m[0], point.position_m[1], point.position_m[2]);
    const Vec3 velocity(point.velocity_mps[0], point.velocity_mps[1], point.velocity_mps[2]);
    reach = std::max({reach, position.norm(), (position + velocity * interval_s).norm()});
  }
  const std::vector<double> heights_m = body_heights_m(target.spec.layout);
  for (std::size_t i = 0; i < target.rest_positions.size(); ++i) {
    const Vec3& rest = target.rest_positions[i];
    // A reflector of a raft turns about the raft's origin with an arm, any other body about its place on the water.
    const Vec3 pivot = is_raft(target.spec.layout) ? raft_origin(target.spec) : Vec3(rest - Vec3(0, 0, heights_m[i]));
    const double arm = (rest - pivot).norm() + target.radii_m[i];
    reach = std::max({reach, pivot.norm() + arm, (pivot + target.relative_velocity_mps * interval_s).norm() + arm});
  }
  return reach;
}

// Throws InputError unless the radar is far from all bodies of one map, including those far from the reference point.
// `companion`: index of the target's companion, if any.
void check_scene_range(const Scenario& scenario, const TargetSpec& spec, const Target& body,
                       std::optional<std::size_t> companion) {
  try {
    check_wavefront_range(reach_m(body, interval_length_s(scenario.radar)), spec.solver.wavefront_range_m);
  } catch (const InputError& error) {
    const std::string key =
        fmt::format("targets.{}.{}", spec.name, companion ? fmt::format("companions.{}", *companion) : "solver");
    throw InputError(fmt::format("{}: {}", place_of(scenario, key), error.what()));
  }
}

// Throws InputError unless the intervals of a realisation are within the time series of the motion.
void check_series(const Scenario& scenario, const SamplePlan& plan, const TargetSpec& spec, const Body& body) {
  const auto* series = std::get_if<AttitudeSeries>(&body.model);
  if (series == nullptr) return;
  try {
    trajectory_of(*series, spec.motion.series_start_s, scene_duration_s(scenario, plan), spec.motion.translations,
                  Vec3::Zero(), Vec3::Zero());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: value {}: {}",
                                 place_of(scenario, fmt::format("targets.{}.motion.series_start_s", spec.name)),
                                 spec.motion.series_start_s, error.what()));
  }
}

Target load_target(const Scenario& scenario, const SamplePlan& plan, const TargetSpec& spec, LoadedBodies& loaded) {
  Target target;
  target.spec = spec;
  if (spec.mesh.empty()) return target;
  target.models = loaded.models(scenario, spec);
  for (const auto& model : target.models) target.radii_m.push_back(model->radius_m);
  check_series(scenario, plan, spec, *target.models.front()->motion);
  return target;
}

// Sets the rest positions of the target's bodies, the first numbered `bodies`, and increases `bodies` by their number.
void place_bodies(Target& target, std::size_t& bodies) {
  target.first_body = bodies;
  if (target.spec.mesh.empty()) return;
  target.rest_positions = rest_positions(target.spec);
  bodies += target.rest_positions.size();
}

// Copy of a target at the place of a companion. Each has its own velocity through the water: a decoy drifts astern of a
// ship under way, whose frame moves with the ship.
Target moved(const Target& original, const TargetSpec& host, const CompanionSpec& companion) {
  Target target = original;
  target.spec.name += " (companion)";
  target.relative_velocity_mps = Vec3(original.spec.motion.speed_mps - host.motion.speed_mps, 0, 0);
  for (PointSpec& point : target.spec.points) {
    point.position_m[0] += companion.x_m;
    point.position_m[1] += companion.y_m;
    point.velocity_mps[0] += target.relative_velocity_mps.x();
  }
  move_layout(target.spec.layout, {companion.x_m, companion.y_m});
  return target;
}

// All targets in order, then the companions, at their places; load(spec) gives a target without them.
std::vector<Target> placed_targets(const Scenario& scenario, const std::function<Target(const TargetSpec&)>& load) {
  std::vector<Target> targets;
  std::size_t bodies = 0;
  for (const TargetSpec& spec : scenario.targets) {
    targets.push_back(load(spec));
    if (spec.role == TargetRole::kPart) continue;  // placed with each target that it accompanies
    place_bodies(targets.back(), bodies);
    check_scene_range(scenario, spec, targets.back(), std::nullopt);
  }
  for (std::size_t t = 0; t < scenario.targets.size(); ++t) {
    for (const CompanionSpec& companion : scenario.targets[t].companions) {
      const auto named = std::find_if(scenario.targets.begin(), scenario.targets.end(),
                                      [&](const TargetSpec& spec) { return spec.name == companion.target; });
      Target target =
          moved(targets[static_cast<std::size_t>(named - scenario.targets.begin())], scenario.targets[t], companion);
      place_bodies(target, bodies);
      check_scene_range(scenario, scenario.targets[t], target, targets[t].companions.size());
      targets[t].companions.push_back(targets.size());
      targets.push_back(std::move(target));
    }
  }
  return targets;
}

// Largest reach of the targets and of their companions, m; a part is only where it accompanies others.
double reach_of_all_m(const Scenario& scenario, const std::vector<Target>& targets) {
  double reach = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const bool alone = t < scenario.targets.size();  // else a companion
    if (alone && targets[t].spec.role == TargetRole::kPart) continue;
    reach = std::max(reach, reach_m(targets[t], interval_length_s(scenario.radar)));
  }
  return reach;
}

// Extent of a turned mesh, neither enlarged nor moved.
struct TurnedMesh {
  TurnedMesh() = default;
  explicit TurnedMesh(const TriangleMesh& mesh) : radius_m(seaglint::radius_m(mesh)), box(bounds(mesh)) {}
  double radius_m = 0;
  Bounds box;
};

// Largest reach of any target with the values drawn in any sea, by meshes as they are in their files. Throws InputError
// where a drawn body is under water.
double largest_reach_m(const Scenario& scenario, const SamplePlan& plan) {
  std::map<std::string, TurnedMesh> meshes;  // by placement and mesh
  double reach = 0;
  for (std::size_t state = 0; state < plan.sea_states().size(); ++state) {
    for (int realisation = 0; realisation < scenario.dataset.realisations_per_case; ++realisation) {
      const Scenario drawn = plan.drawn(scenario, {.sea_state = static_cast<int>(state), .realisation = realisation});
      const std::vector<Target> targets = placed_targets(drawn, [&](const TargetSpec& spec) {
        Target target;
        target.spec = spec;
        if (spec.mesh.empty()) return target;
        const MeshPlacement turned = turned_mesh(spec);
        const std::string mesh = placement_text(turned) + " " + spec.mesh;
        if (!meshes.contains(mesh)) meshes[mesh] = TurnedMesh(read_placed_mesh(find_mesh(drawn, spec), turned));
        check_above_water(drawn, spec, meshes[mesh].box);
        const double offset_m = Vec3(spec.offset_m).norm();
        for (const double scale : body_scales(spec.layout, spec.scale))
          target.radii_m.push_back(scale * (meshes[mesh].radius_m + offset_m / spec.scale));
        return target;
      });
      reach = std::max(reach, reach_of_all_m(drawn, targets));
    }
  }
  return reach;
}

bool draws_targets(const Scenario& scenario) {
  return std::any_of(scenario.variations.begin(), scenario.variations.end(),
                     [](const Variation& variation) { return variation.key_path.starts_with("targets."); });
}

}  // namespace

std::vector<Target> load_targets(const Scenario& scenario, const SamplePlan& plan, LoadedBodies* loaded) {
  LoadedBodies alone;
  return placed_targets(
      scenario, [&](const TargetSpec& spec) { return load_target(scenario, plan, spec, loaded ? *loaded : alone); });
}

double range_window_m(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets) {
  const double drawn_reach = draws_targets(scenario) ? largest_reach_m(scenario, plan) : 0;
  const double reach = std::max(drawn_reach, reach_of_all_m(scenario, targets));
  // 10 % larger than the target, since bodies drift and multiply reflected paths are longer than direct ones.
  const double window_m = std::max(scenario.map.range_span_m, 2.2 * reach);
  const RadarSpec& radar = scenario.radar;
  const double echo_us = echo_duration_us(radar, window_m);
  if (echo_us > radar.pri_us) {
    throw InputError(fmt::format(
        "{}: a target reaches {:.6g} m from the reference point: its echo lasts {:.6g} us with the pulse and "
        "must end within radar.pri_us, {}",
        place_of(scenario, "targets"), reach, echo_us, radar.pri_us));
  }
  return window_m;
}

Scene make_scene(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets, int sea_state,
                 int realisation, double at_least_s) {
  const SeaState state = plan.sea_state({.sea_state = sea_state, .realisation = realisation});
  const std::uint64_t key = sea_key(static_cast<std::size_t>(sea_state), static_cast<std::size_t>(realisation));
  const double duration_s = std::max(at_least_s, scene_duration_s(scenario, plan));

  Scene scene{realise_sea(state, scenario.seed, key), {}, {}};
  for (const Target& target : targets) {
    std::vector<const Body*> motions;
    for (const auto& model : target.models) motions.push_back(model->motion.get());
    scene.bodies.push_back(target.rest_positions.empty()
                               ? std::vector<Trajectory>{}
                               : simulate_target(target.spec, motions, state, scene.sea, duration_s, scenario.seed, key,
                                                 target.first_body));
  }
  return scene;
}

}  // namespace seaglint

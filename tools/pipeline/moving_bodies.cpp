// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/moving_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <variant>

#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/mesh_placement.h"
#include "sim/motion/ship/rao_table.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/sample_plan.h"
#include "sim/sea/realisation.h"
#include "tools/target/body_model.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxRealisations = 1000000;  // of sea_key()

// Mean velocity of a body along x, without its motion in the waves, m/s.
double mean_speed(const Body& body) {
  if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) return ship->speed;
  if (const auto* table = std::get_if<RaoTable>(&body.model)) return table->speed();
  return 0;
}

// A body of one size: its mesh and its motion model.
struct SizedBody {
  TriangleMesh mesh;
  Body motion;
};

// Those of a target by the factors of their sizes.
std::map<double, SizedBody> bodies_of(const Scenario& scenario, const TargetSpec& target, const StopFlag& stop) {
  const TriangleMesh mesh = read_mesh(find_mesh(scenario, target), target.unit);
  check_above_water(scenario, target, bounds(placed(mesh, turned_mesh(target))));
  std::map<double, SizedBody> sizes;
  for (const double scale : body_scales(target.layout, target.scale)) {
    if (sizes.contains(scale)) continue;
    if (stop) throw Interrupted();
    TriangleMesh large = placed(mesh, with_scale(target, scale));
    Body motion =
        sizes.empty() || moves_by_size(target) ? load_body(scenario, target, large) : sizes.begin()->second.motion;
    sizes.emplace(scale, SizedBody{std::move(large), std::move(motion)});
  }
  return sizes;
}

}  // namespace

ChosenSea choose_sea(const Scenario& scenario, const SeaChoice& choice) {
  const std::vector<SeaState> states = sea_states(scenario.sea);
  if (choice.sea_state >= states.size())
    throw InputError(
        fmt::format("sea_state {}: must be within 0 and {}, the scenario's last", choice.sea_state, states.size() - 1));
  if (choice.realisation >= kMaxRealisations)
    throw InputError(fmt::format("realisation {}: must be within 0 and {}", choice.realisation, kMaxRealisations - 1));
  const SeaState& state = states[choice.sea_state];
  return {state, realise_sea(state, scenario.seed, sea_key(choice.sea_state, choice.realisation))};
}

MovingBodies simulate_bodies(const Scenario& scenario, const SeaChoice& choice, double duration_s, int threads,
                             const StopFlag& stop, const std::function<void(const TargetSpec&, const Body&)>& loaded) {
  MovingBodies scene{choose_sea(scenario, choice), {}, {}};
  const std::uint64_t key = sea_key(choice.sea_state, choice.realisation);
  std::size_t first_body = 0;
  for (const TargetSpec& target : scenario.targets) {
    if (target.mesh.empty() || target.role == TargetRole::kPart) continue;
    if (stop) throw Interrupted();
    const std::map<double, SizedBody> sizes = bodies_of(scenario, target, stop);
    const std::vector<double> scales = body_scales(target.layout, target.scale);
    std::vector<const Body*> models;
    for (const double scale : scales) models.push_back(&sizes.at(scale).motion);
    const Body& first = scene.targets.emplace_back(*models.front());
    loaded(target, first);
    const std::vector<Trajectory> all = simulate_target(target, models, scene.sea.state, scene.sea.field, duration_s,
                                                        scenario.seed, key, first_body, threads);
    first_body += all.size();
    const std::size_t moving = is_raft(target.layout) ? 1 : all.size();
    for (std::size_t i = 0; i < moving; ++i) {
      scene.bodies.push_back(
          {target.layout && !is_raft(target.layout) ? fmt::format("{}_{}", target.name, i + 1) : target.name, all[i],
           sizes.at(scales[i]).mesh, mean_speed(*models[i])});
    }
  }
  if (scene.bodies.empty()) throw InputError("targets: none of them is a mesh, so nothing moves in the waves");
  return scene;
}

std::vector<std::string> uncovered_waves(const MovingBodies& scene) {
  std::vector<std::string> sentences;
  for (const Body& body : scene.targets) {
    if (const auto* table = std::get_if<RaoTable>(&body.model)) {
      sentences.push_back(fmt::format("{}: {:.3g} % of the waves' variance lies outside of its frequencies",
                                      table->source(), 100 * table->uncovered_variance_fraction(scene.sea.field)));
    }
  }
  return sentences;
}

MotionSample motion_at(const NamedTrajectory& body, double t) {
  return body.trajectory.sample(std::min(t, body.trajectory.end_s()));
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/moving_bodies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <variant>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/motion/ship/rao_table.h"
#include "sim/motion/statistics.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/sample_plan.h"
#include "sim/sea/realisation.h"
#include "tools/pipeline/body_model.h"
#include "tools/pipeline/warnings.h"

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

namespace {

constexpr double kDuration_s = 100;

// Motion of a body at the origin over 100 s, or over the scenario's intervals where its series ends before that.
Trajectory trial_motion(const Pipeline& pipeline, const Target& target, const WaveField& sea, std::uint64_t key) {
  const Scenario& scenario = pipeline.scenario();
  const auto simulated = [&](double duration_s) {
    return simulate_motion(*target.models.front()->motion, Vec3::Zero(), sea, duration_s, scenario.seed,
                           body_index(key, target.first_body));
  };
  try {
    return simulated(kDuration_s);
  } catch (const InputError&) {
    return simulated(pipeline.plan().last_start_s() + scenario.radar.pulses * scenario.radar.pri_us * 1e-6);
  }
}

// Why degree of freedom i of a moving target is 0.
std::string rest_reason(const TargetSpec& target, std::size_t i) {
  const MotionSpec& motion = target.motion;
  const std::string path = fmt::format("targets.{}.motion", target.name);
  if (i >= 3 && !motion.translations) return fmt::format("without {}.translations: true", path);
  if (motion.model == MotionModel::kSeries) return fmt::format("in its file ({}.file)", path);
  if (i == 2 && motion.model == MotionModel::kFloat && motion.yaw_rate_std_deg_s == 0)
    return fmt::format("without {}.yaw_rate_std_deg_s", path);
  if (motion.model == MotionModel::kRao)
    return fmt::format("in its table or in these waves ({}.file, sea.propagation_deg)", path);
  return "in these waves (sea.significant_wave_height_m, sea.propagation_deg, sea.spreading)";
}

// Whether the scenario has a section `motion` of the target.
bool has_motion_section(const Scenario& scenario, const TargetSpec& target) {
  const YamlNode* node = scenario.document ? &scenario.document->root : nullptr;
  for (const std::string& key : {std::string("targets"), target.name, std::string("motion")})
    node = node == nullptr ? nullptr : node->find(key);
  return node != nullptr;
}

}  // namespace

std::vector<TargetMotion> target_motions(const Pipeline& pipeline) {
  const Scenario& scenario = pipeline.scenario();
  const std::vector<SeaState>& states = pipeline.plan().sea_states();
  const auto highest = std::ranges::max_element(states, {}, total_wave_height);
  const std::uint64_t key = sea_key(static_cast<std::size_t>(highest - states.begin()), 0);
  const WaveField sea = realise_sea(*highest, scenario.seed, key);
  std::vector<TargetMotion> motions;
  for (std::size_t t = 0; t < scenario.targets.size(); ++t) {
    const Target& target = pipeline.targets()[t];
    if (target.models.empty()) continue;
    try {
      motions.push_back({&scenario.targets[t], motion_rms(trial_motion(pipeline, target, sea, key), kDuration_s)});
    } catch (const InputError&) {
      continue;  // its responses do not cover this sea
    }
  }
  return motions;
}

std::string motion_text(const TargetMotion& motion) {
  std::string text;
  for (const bool angles : {true, false}) {
    std::vector<std::string> parts;
    for (std::size_t i = angles ? 0 : 3; i < (angles ? 3u : 6u); ++i) {
      if (motion.rms[i] > 0)
        parts.push_back(
            fmt::format("{} {:.3g}", kDegreesOfFreedom[i], angles ? degrees(motion.rms[i]) : motion.rms[i]));
    }
    if (parts.empty()) continue;
    if (!text.empty()) text += "; ";
    text += fmt::format("{} {} rms", fmt::join(parts, ", "), angles ? "deg" : "m");
  }
  return text;
}

std::string rest_text(const TargetMotion& motion) {
  const TargetSpec& target = *motion.target;
  if (target.motion.model == MotionModel::kFixed)
    return fmt::format("does not move: targets.{0}.motion.model is fixed", target.name);
  std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
  for (std::size_t i = 0; i < motion.rms.size(); ++i) {
    if (motion.rms[i] > 0) continue;
    const std::string reason = rest_reason(target, i);
    auto known = std::ranges::find(by_reason, reason, &decltype(by_reason)::value_type::first);
    if (known == by_reason.end()) known = by_reason.insert(by_reason.end(), {reason, {}});
    known->second.emplace_back(kDegreesOfFreedom[i]);
  }
  std::string text;
  for (const auto& [reason, names] : by_reason)
    text += fmt::format("{}{} {} 0 {}", text.empty() ? "" : "; ", fmt::join(names, ", "),
                        names.size() == 1 ? "is" : "are", reason);
  return text;
}

void report_rest(const Scenario& scenario, const std::vector<TargetMotion>& motions) {
  for (const TargetMotion& motion : motions) {
    if (motion.target->motion.model == MotionModel::kFixed && has_motion_section(scenario, *motion.target)) continue;
    const std::string text = rest_text(motion);
    if (!text.empty()) warn(std::array{fmt::format("targets.{}: {}", motion.target->name, text)});
  }
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/scene.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/decoy/make_decoy.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/geometry/ship/make_ship.h"
#include "sim/motion/target_motion.h"
#include "sim/scattering/observation/observation.h"
#include "sim/sea/realisation.h"

namespace seaglint {

namespace {

double largest_radius_m(const TriangleMesh& mesh) {
  double radius = 0;
  for (const Vec3& vertex : mesh.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}

// How the source mesh becomes that of a body of one size: enlarged, then moved.
MeshPlacement placement_of(const TargetSpec& spec, double scale) {
  const MeshPlacement whole = with_scale(spec, scale);
  MeshPlacement placement;
  placement.scale = whole.scale;
  placement.offset_m = whole.offset_m;
  return placement;
}

Bounds box_of(const SourceMesh& source, const MeshPlacement& placement) {
  const Vec3 offset(placement.offset_m);
  return {placement.scale * source.box.lower + offset, placement.scale * source.box.upper + offset};
}

MeshPlacement axes_of(const TargetSpec& spec) {
  MeshPlacement axes;
  axes.unit = spec.unit;
  axes.forward = spec.forward;
  axes.up = spec.up;
  return axes;
}

// Mesh and materials of a body of one size, with their keys for error messages.
TargetSource source_of(const Scenario& scenario, const TargetSpec& spec, double scale,
                       std::shared_ptr<const SourceMesh> mesh) {
  const std::string path = "targets." + spec.name;
  TargetSource source{.mesh = is_generated(spec) ? std::filesystem::path() : find_mesh(scenario, spec),
                      .placement = placement_of(spec, scale),
                      .loaded = std::shared_ptr<const TriangleMesh>(mesh, &mesh->mesh),
                      .materials = {},
                      .material_folder = scenario.folder,
                      .lowest_hz = 1e9 * lowest_ghz(scenario.radar),
                      .highest_hz = 1e9 * highest_ghz(scenario.radar),
                      .materials_place = place_of(scenario, path),
                      .frequencies_place = place_of(scenario, path),
                      .mesh_place = place_of(scenario, path + "." + source_key_of(spec)),
                      .all_conductor = "part_materials: [{part: '*', material: pec}]"};
  for (std::size_t i = 0; i < spec.part_materials.size(); ++i) {
    const PartMaterialSpec& part = spec.part_materials[i];
    source.materials.push_back(
        {part.part, part.material, place_of(scenario, fmt::format("{}.part_materials.{}.material", path, i))});
  }
  // The default leaves its faces the materials of the mesh.
  if (spec.material != Material{}.name)
    source.materials.push_back({std::nullopt, spec.material, place_of(scenario, path + ".material")});
  return source;
}

// height_m: of the mesh's origin above the water; absent where the body does not reach the water.
ScattererSettings scatterer_settings(const Scenario& scenario, const TargetSpec& spec, std::optional<double> height_m) {
  return {.waterline_m = height_m ? std::optional(-*height_m) : std::nullopt,
          .sea_reflects = height_m && scenario.sea_reflection.enabled,
          .crease_rad = spec.solver.crease_deg ? std::optional(radians(*spec.solver.crease_deg)) : std::nullopt,
          .sheet_thickness_m = 1e-3 * spec.sheet_thickness_mm,
          .edges = spec.solver.edges,
          .lowest_hz = 1e9 * lowest_ghz(scenario.radar),
          .highest_hz = 1e9 * highest_ghz(scenario.radar)};
}

// Whether the motion model depends on the mesh: of ships and floats that are no raft.
bool moves_by_size(const TargetSpec& spec) {
  const MotionModel model = spec.motion.model;
  return !is_raft(spec.layout) && (model == MotionModel::kShip || model == MotionModel::kFloat);
}

// Motion model of a body from its enlarged mesh, of a rigid raft from the keys alone.
// centre_of_gravity_m: height above the waterline, where the mesh's generator gives it.
Body load_body(const Scenario& scenario, const TargetSpec& spec, const TriangleMesh& mesh, double scale,
               std::optional<double> centre_of_gravity_m) {
  MotionSpec motion = spec.motion;
  // The line of a decoy does not float.
  if (spec.decoy && !is_raft(spec.layout) && motion.diameter_m == 0)
    motion.diameter_m = scale * decoy_float_m(*spec.decoy);
  try {
    return make_body(
        motion,
        is_raft(spec.layout) ? BodyShape{.box = {}, .hull = {}, .is_raft = true} : shape_of(mesh, centre_of_gravity_m),
        scenario.folder);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", place_of(scenario, "targets." + spec.name), error.what()));
  }
}

// Memory of a value in triangles of a scatterer.
std::size_t size_of(const SourceMesh& source) { return 100 + source.mesh.triangles.size() / 4; }
std::size_t size_of(const PreparedTarget& target) { return 500 + target.mesh.triangles.size(); }
std::size_t size_of(const Body&) { return 3000; }

}  // namespace

template <class Key, class Value>
std::shared_ptr<typename TargetCache::Kept<Key, Value>::Entry> TargetCache::Kept<Key, Value>::entry_of(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find_if(entries_, [&](const auto& entry) { return entry->key == key; });
  std::shared_ptr<Entry> entry = known == entries_.end() ? std::make_shared<Entry>(key) : *known;
  if (known != entries_.end()) entries_.erase(known);
  // From the one used last back: what exceeds the sum goes, and what could not be made.
  std::size_t unused = 0;
  for (std::size_t i = entries_.size(); i-- > 0;) {
    if (entries_[i].use_count() > 1) continue;  // a thread makes it, or waits for it
    bool is_empty = false;
    {
      const std::lock_guard made(entries_[i]->making);
      std::shared_ptr<const Value>& value = entries_[i]->value;
      if (value.use_count() == 1 && (unused += size_of(*value)) > kMostTriangles) value = nullptr;
      is_empty = value == nullptr;
    }
    if (is_empty) entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return entries_.emplace_back(std::move(entry));
}

template <class Key, class Value>
template <class Make>
std::shared_ptr<const Value> TargetCache::Kept<Key, Value>::get(const Key& key, const Make& make) {
  const std::shared_ptr<Entry> entry = entry_of(key);
  const std::lock_guard lock(entry->making);
  if (!entry->value) entry->value = std::make_shared<const Value>(make());
  return entry->value;
}

TargetCache::SourceKey TargetCache::source_key(const Scenario& scenario, const TargetSpec& spec) {
  SourceKey key{is_generated(spec) ? std::filesystem::path() : find_mesh(scenario, spec), spec.ship, spec.decoy,
                axes_of(spec)};
  // The mast reaches down to the water.
  if (key.decoy && key.decoy->support != DecoySupport::kNone && rest_height_m(spec) > 0)
    key.decoy->mast_m = rest_height_m(spec) / spec.scale;
  return key;
}

std::shared_ptr<const SourceMesh> TargetCache::source(const Scenario& scenario, const TargetSpec& spec) {
  const SourceKey key = source_key(scenario, spec);
  return sources_.get(key, [&]() -> SourceMesh {
    SourceMesh source;
    if (key.ship) {
      Ship ship = make_ship(*key.ship);
      source.mesh = std::move(ship.mesh);
      source.centre_of_gravity_m = ship.centre_of_gravity_m;
    } else if (key.decoy) {
      try {
        source.mesh = make_decoy(*key.decoy);
      } catch (const InputError& error) {
        throw InputError(
            fmt::format("{}: {}", place_of(scenario, fmt::format("targets.{}.decoy", spec.name)), error.what()));
      }
    } else {
      source.mesh = read_placed_mesh(key.file, key.axes);
    }
    source.box = bounds(source.mesh);
    source.radius_m = largest_radius_m(source.mesh);
    return source;
  });
}

BodyModel TargetCache::model(const Scenario& scenario, const TargetSpec& spec, double scale,
                             std::optional<double> height_m, bool with_scatterer) {
  BodyModel model;
  model.scale = scale;
  model.source = source(scenario, spec);
  model.box = box_of(*model.source, placement_of(spec, scale));
  std::optional<TargetMesh> placed_mesh;
  const auto mesh = [&]() -> TargetMesh& {
    if (placed_mesh) return *placed_mesh;
    placed_mesh = load_target_mesh(source_of(scenario, spec, scale, model.source));
    // Its sheets are open on purpose.
    if (is_generated(spec)) placed_mesh->warnings = check_target(placed_mesh->mesh, 1e9 * lowest_ghz(scenario.radar));
    return *placed_mesh;
  };
  const SourceKey key = source_key(scenario, spec);
  std::optional<double> gravity_m = model.source->centre_of_gravity_m;
  if (gravity_m) *gravity_m *= scale;
  model.motion = motions_.get(
      {key, placement_of(spec, moves_by_size(spec) ? scale : 1), scenario.folder, spec.motion, is_raft(spec.layout)},
      [&] { return load_body(scenario, spec, mesh().mesh, scale, gravity_m); });
  if (!with_scatterer) return model;
  const ScattererSettings settings = scatterer_settings(scenario, spec, height_m);
  model.prepared =
      prepared_.get({key, placement_of(spec, scale), scenario.folder, spec.material, spec.part_materials, settings},
                    [&] { return prepare_target(std::move(mesh()), settings); });
  model.radius_m = largest_radius_m(model.prepared->mesh);
  return model;
}

namespace {

double interval_length_s(const RadarSpec& radar) { return radar.pulses * radar.pri_us * 1e-6; }

// From the first pulse of a sample to its last.
double sample_length_s(const Scenario& scenario) {
  return scenario.looks.last_start_s() + interval_length_s(scenario.radar);
}

// From t = 0 to the end of a realisation's last interval.
double scene_duration_s(const Scenario& scenario, const SamplePlan& plan) {
  return plan.last_start_s() + sample_length_s(scenario);
}

// Of a body of one size, above its mesh origin, m, with the margin of what counts as in the water surface.
struct HeightsOfBody {
  double bottom_m = 0, top_m = 0, margin_m = 0;
};

HeightsOfBody heights_of(const TargetSpec& spec, const SourceMesh& source, double scale) {
  const Bounds body = box_of(source, placement_of(spec, scale));
  return {body.lower.z(), body.upper.z(), waterline_margin(body)};
}

// The target of one body of its layout: decoys with random imperfections are individuals.
TargetSpec spec_of_body(TargetSpec spec, std::size_t body) {
  if (spec.decoy) spec.decoy = decoy_of_body(*spec.decoy, body);
  return spec;
}

// Throws InputError for a body of a layout that is entirely under water and, if the sea reflects, for one of bodies at
// several heights that reaches into the water.
void check_above_water(const Scenario& scenario, const TargetSpec& spec, std::size_t body, double height_m,
                       const HeightsOfBody& heights) {
  const std::string target = fmt::format("targets.{}", spec.name);
  const double top_m = heights.top_m + height_m, bottom_m = heights.bottom_m + height_m;
  const bool has_heights = spec.layout && spec.layout->heights_m;
  if (scenario.sea_reflection.enabled && has_heights && bottom_m < 0) {
    throw InputError(
        fmt::format("{}: its lowest body reaches {:.6g} m below the water: with sea_reflection bodies at several "
                    "heights must be above it",
                    place_of(scenario, target + ".layout.heights"), -bottom_m));
  }
  // A plate in the water surface is not below it.
  if (top_m > heights.margin_m || (!scenario.sea_reflection.enabled && bottom_m >= -heights.margin_m)) return;
  if (has_heights) {
    throw InputError(
        fmt::format("{}: body {} reaches up to {:.6g} m above the water: must be above 0, else the whole "
                    "body is under water",
                    place_of(scenario, target + ".layout.heights"), body + 1, top_m));
  }
  if (spec.motion.model == MotionModel::kFloat || is_moving_raft(spec)) {
    throw InputError(fmt::format("{}: value {}: must be greater than {:.6g}, else the whole target is under water",
                                 place_of(scenario, target + ".motion.origin_above_waterline_m"), height_m,
                                 -heights.top_m));
  }
  throw InputError(
      fmt::format("{}: its highest point is at z = {:.6g} m: must be above 0, the water, else the whole target is "
                  "under water; offset_m lifts it",
                  place_of(scenario, target + "." + source_key_of(spec)), heights.top_m));
}

// Throws InputError for more different bodies of one target than memory is expected to hold: up to 2 GB per million
// triangles.
void check_memory(const Scenario& scenario, const TargetSpec& spec, std::size_t bodies, std::size_t triangles) {
  constexpr std::size_t kMostTriangles = 2'000'000;
  if (bodies == 1 || bodies * triangles <= kMostTriangles) return;
  throw InputError(
      fmt::format("{}: {} different bodies with {} triangles each: must have at most {} triangles in all",
                  place_of(scenario, fmt::format("targets.{}.layout{}", spec.name, spec.decoy ? "" : ".scales")),
                  bodies, triangles, kMostTriangles));
}

// The models of a target's bodies, in their order.
std::vector<std::shared_ptr<const BodyModel>> load_models(const TargetRequest& request, const TargetSpec& spec,
                                                          TargetCache& cache) {
  const Scenario& scenario = request.scenario;
  const std::vector<double> scales = body_scales(spec.layout, spec.scale), heights_m = body_heights_m(spec.layout);
  // By the seed of a decoy, the scale, and the height of those in the water.
  using Individual = std::tuple<std::uint64_t, double, std::optional<double>>;
  std::vector<Individual> bodies;
  std::map<Individual, TargetSpec> specs;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const TargetSpec of_body = spec_of_body(spec, i);
    const double height_m = rest_height_m(spec) + heights_m[i];
    const HeightsOfBody heights = heights_of(of_body, *cache.source(scenario, of_body), scales[i]);
    check_above_water(scenario, spec, i, height_m, heights);
    const bool touches = scenario.sea_reflection.enabled ? heights.bottom_m + height_m <= heights.margin_m
                                                         : heights.bottom_m + height_m < -heights.margin_m;
    bodies.emplace_back(of_body.decoy ? of_body.decoy->seed : 0, scales[i],
                        touches ? std::optional(height_m) : std::nullopt);
    specs.try_emplace(bodies.back(), of_body);
  }
  const bool for_echoes = request.use == TargetUse::kEcho;
  std::map<Individual, std::shared_ptr<const BodyModel>> made;
  for (const auto& [individual, of_body] : specs) {
    if (request.stop != nullptr && *request.stop) throw Interrupted();
    const auto& [seed, scale, height_m] = individual;
    made[individual] = std::make_shared<const BodyModel>(cache.model(scenario, of_body, scale, height_m, for_echoes));
    if (for_echoes) check_memory(scenario, spec, specs.size(), made[individual]->prepared->mesh.triangles.size());
  }
  std::vector<std::shared_ptr<const BodyModel>> models;
  for (const auto& body : bodies) models.push_back(made.at(body));
  return models;
}

// Throws InputError unless the intervals of a realisation are within the time series of the motion.
void check_series(const TargetRequest& request, const TargetSpec& spec, const Body& body) {
  const auto* series = std::get_if<AttitudeSeries>(&body.model);
  if (series == nullptr) return;
  try {
    trajectory_of(*series, spec.motion.series_start_s, scene_duration_s(request.scenario, request.plan),
                  spec.motion.translations, Vec3::Zero(), Vec3::Zero());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: value {}: {}",
                                 place_of(request.scenario, fmt::format("targets.{}.motion.series_start_s", spec.name)),
                                 spec.motion.series_start_s, error.what()));
  }
}

// Radius, m, about the target's reference point within which the target stays.
double reach_m(const Target& target, double interval_s) {
  double reach = 0;
  for (const PointSpec& point : target.spec.points) {
    const Vec3 position(point.position_m), velocity(point.velocity_mps);
    reach = std::max({reach, position.norm(), (position + velocity * interval_s).norm()});
  }
  const std::vector<double> heights_m = body_heights_m(target.spec.layout);
  for (std::size_t i = 0; i < target.rest_positions.size(); ++i) {
    const Vec3& rest = target.rest_positions[i];
    // A reflector of a raft turns about the raft's origin with an arm, any other body about its place on the water.
    const Vec3 pivot = is_raft(target.spec.layout) ? raft_origin(target.spec) : Vec3(rest - Vec3(0, 0, heights_m[i]));
    const double arm = (rest - pivot).norm() + target.radii_m[i];
    const DriftSpec drift = target.spec.motion.drift.value_or(DriftSpec{});
    const Vec3 passed_m = (target.relative_velocity_mps + mean_drift_mps(target.spec.motion)) * interval_s;
    constexpr double kDeviations = 5;  // of a body's own drift
    reach = std::max(
        {reach, pivot.norm() + arm, (pivot + passed_m).norm() + arm + kDeviations * drift.spread_mps * interval_s});
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

// Sets the rest positions of the target's bodies, the first numbered `bodies`, and increases `bodies` by their number.
void place_bodies(Target& target, std::size_t& bodies) {
  target.first_body = bodies;
  if (!has_mesh(target.spec)) return;
  target.rest_positions = rest_positions(target.spec);
  bodies += target.rest_positions.size();
}

// Copy of a target at the place of a companion. Each has its own velocity through the water: a decoy drifts astern of a
// ship under way, whose frame moves with the ship; a towed one has the ship's.
Target moved(const Target& original, const TargetSpec& host, const CompanionSpec& companion) {
  Target target = original;
  target.spec.name += " (companion)";
  if (companion.towed) target.spec.motion.speed_mps = host.motion.speed_mps;
  target.relative_velocity_mps = Vec3(target.spec.motion.speed_mps - host.motion.speed_mps, 0, 0);
  for (PointSpec& point : target.spec.points) {
    point.position_m[0] += companion.x_m;
    point.position_m[1] += companion.y_m;
    point.velocity_mps[0] += target.relative_velocity_mps.x();
  }
  move_layout(target.spec.layout, {companion.x_m, companion.y_m});
  return target;
}

// All targets in order, then the companions, at their places; load(target) sets what a mesh determines, of all or of
// one target and its companions only.
template <class Load>
std::vector<Target> placed_targets(const Scenario& scenario, TargetUse use, std::optional<std::size_t> only,
                                   const Load& load) {
  const auto is_needed = [&](const TargetSpec& spec) {
    if (!only) return true;
    const TargetSpec& of = scenario.targets[*only];
    return spec.name == of.name ||
           std::ranges::find(of.companions, spec.name, &CompanionSpec::target) != of.companions.end();
  };
  std::vector<Target> targets;
  std::size_t bodies = 0;
  for (const TargetSpec& spec : scenario.targets) {
    Target& target = targets.emplace_back();
    target.spec = spec;
    const bool is_part = spec.role == TargetRole::kPart;  // placed with each target that it accompanies
    const bool has_models = has_mesh(spec) && is_needed(spec) && !(is_part && use == TargetUse::kMotion);
    if (has_models) load(target);
    if (is_part) continue;
    place_bodies(target, bodies);
    if (use == TargetUse::kEcho && is_needed(spec)) check_scene_range(scenario, spec, target, std::nullopt);
  }
  if (use == TargetUse::kMotion) return targets;
  for (std::size_t t = 0; t < scenario.targets.size(); ++t) {
    if (only && t != *only) continue;
    for (const CompanionSpec& companion : scenario.targets[t].companions) {
      const auto named = std::ranges::find(scenario.targets, companion.target, &TargetSpec::name);
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

// Largest reach of any target with the values drawn in any sea, by meshes as they are in their files. Throws InputError
// where a drawn body is under water.
double largest_reach_m(const TargetRequest& request, TargetCache& cache) {
  double reach = 0;
  for (std::size_t state = 0; state < request.plan.sea_states().size(); ++state) {
    for (int realisation = 0; realisation < request.scenario.dataset.realisations_per_case; ++realisation) {
      const Scenario drawn =
          request.plan.drawn(request.scenario, {.sea_state = static_cast<int>(state), .realisation = realisation});
      const std::vector<Target> targets = placed_targets(drawn, request.use, std::nullopt, [&](Target& target) {
        const TargetSpec& spec = target.spec;
        if (spec.ship) {
          for (const double scale : body_scales(spec.layout, spec.scale))
            target.radii_m.push_back(scale * ship_reach_m(*spec.ship));
          return;
        }
        TargetSpec perfect = spec;
        if (spec.decoy) perfect.decoy = without_imperfections(*spec.decoy);
        const std::shared_ptr<const SourceMesh> source = cache.source(drawn, perfect);
        const double more_m = spec.decoy ? largest_displacement_m(*spec.decoy) : 0,
                     offset_m = Vec3(spec.offset_m).norm();
        const std::vector<double> scales = body_scales(spec.layout, spec.scale);
        const std::vector<double> heights_m = body_heights_m(spec.layout);
        for (std::size_t i = 0; i < scales.size(); ++i) {
          check_above_water(drawn, spec, i, rest_height_m(spec) + heights_m[i], heights_of(spec, *source, scales[i]));
          target.radii_m.push_back(scales[i] * (source->radius_m + more_m + offset_m / spec.scale));
        }
      });
      reach = std::max(reach, reach_of_all_m(drawn, targets));
    }
  }
  return reach;
}

}  // namespace

bool draws_targets(const Scenario& scenario) {
  return std::ranges::any_of(scenario.variations,
                             [](const Variation& variation) { return variation.key_path.starts_with("targets."); });
}

std::vector<Target> load_targets(const TargetRequest& request) {
  TargetCache alone;
  TargetCache& cache = request.cache ? *request.cache : alone;
  return placed_targets(request.scenario, request.use, request.only, [&](Target& target) {
    target.models = load_models(request, target.spec, cache);
    for (const auto& model : target.models) target.radii_m.push_back(model->radius_m);
    if (request.use == TargetUse::kEcho) check_series(request, target.spec, *target.models.front()->motion);
  });
}

double range_window_m(const TargetRequest& request, const std::vector<Target>& targets) {
  const Scenario& scenario = request.scenario;
  TargetCache alone;
  const double drawn_reach =
      draws_targets(scenario) ? largest_reach_m(request, request.cache ? *request.cache : alone) : 0;
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

ChosenSea choose_sea(const Scenario& scenario, const SeaChoice& choice) {
  constexpr std::size_t kMaxRealisations = 1000000;  // of sea_key()
  const std::vector<SeaState> states = sea_states(scenario.sea);
  if (choice.sea_state >= states.size())
    throw InputError(
        fmt::format("sea_state {}: must be within 0 and {}, the scenario's last", choice.sea_state, states.size() - 1));
  if (choice.realisation >= kMaxRealisations)
    throw InputError(fmt::format("realisation {}: must be within 0 and {}", choice.realisation, kMaxRealisations - 1));
  const SeaState& state = states[choice.sea_state];
  return {state, realise_sea(state, scenario.seed, sea_key(choice.sea_state, choice.realisation))};
}

Scene make_scene(const SceneRequest& request) {
  const std::uint64_t key = sea_key(request.sea.sea_state, request.sea.realisation);
  Scene scene;
  double duration_s = request.at_least_s;
  if (request.plan != nullptr) {
    scene.state = request.plan->sea_state({.sea_state = static_cast<int>(request.sea.sea_state),
                                           .realisation = static_cast<int>(request.sea.realisation)});
    scene.sea = realise_sea(scene.state, request.scenario.seed, key);
    duration_s = std::max(duration_s, scene_duration_s(request.scenario, *request.plan));
  } else {
    ChosenSea chosen = choose_sea(request.scenario, request.sea);
    scene.state = chosen.state;
    scene.sea = std::move(chosen.field);
  }
  for (const Target& target : request.targets) {
    if (request.stop != nullptr && *request.stop) throw Interrupted();
    std::vector<Trajectory>& bodies = scene.bodies.emplace_back();
    std::vector<Vec3>& velocities_mps = scene.velocities_mps.emplace_back();
    if (target.models.empty() || target.rest_positions.empty()) continue;  // not loaded, or a part
    velocities_mps = drift_velocities_mps(target.spec, request.scenario.seed, key, target.first_body);
    for (Vec3& velocity : velocities_mps) velocity = target.relative_velocity_mps + velocity;
    std::vector<const Body*> models;
    for (const auto& model : target.models) models.push_back(model->motion.get());
    bodies = simulate_target({.target = target.spec,
                              .models = models,
                              .state = scene.state,
                              .sea = scene.sea,
                              .duration_s = duration_s,
                              .seed = request.scenario.seed,
                              .sea_index = key,
                              .first_body = target.first_body,
                              .threads = request.threads});
  }
  return scene;
}

namespace {

// Mean velocity of a body along x, without its motion in the waves, m/s.
double mean_speed(const Body& body) {
  if (const auto* ship = std::get_if<ShipParticulars>(&body.model)) return ship->speed;
  if (const auto* table = std::get_if<RaoTable>(&body.model)) return table->speed();
  return 0;
}

}  // namespace

std::vector<NamedTrajectory> named_bodies(const std::vector<Target>& targets, const Scene& scene) {
  std::vector<NamedTrajectory> bodies;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const Target& target = targets[t];
    const bool raft = is_raft(target.spec.layout);
    for (std::size_t i = 0; i < scene.bodies[t].size() && !(raft && i > 0); ++i) {
      const BodyModel& model = *target.models[i];
      bodies.push_back({target.spec.layout && !raft ? fmt::format("{}_{}", target.spec.name, i + 1) : target.spec.name,
                        scene.bodies[t][i], placed(model.source->mesh, placement_of(target.spec, model.scale)),
                        mean_speed(*model.motion)});
    }
  }
  if (targets.size() == 1 && is_sea_alone(targets.front().spec))
    throw InputError("targets: {} is the sea alone: a motion needs a target with a mesh");
  if (bodies.empty()) throw InputError("targets: none of them is a mesh, so nothing moves in the waves");
  return bodies;
}

MotionSample motion_at(const NamedTrajectory& body, double t) {
  return body.trajectory.sample(std::min(t, body.trajectory.end_s()));
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/target/body_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/writer.h"

namespace seaglint {

double radius_m(const TriangleMesh& mesh) {
  double radius = 0;
  for (const Vec3& vertex : mesh.vertices) radius = std::max(radius, vertex.norm());
  return radius;
}

namespace {

// Mesh, enlarged by `scale`, and materials of a target, with their keys for error messages.
TargetSource source_of(const Scenario& scenario, const TargetSpec& spec, double scale) {
  const std::string path = "targets." + spec.name;
  TargetSource source{.mesh = find_mesh(scenario, spec),
                      .unit = spec.unit,
                      .loaded = nullptr,
                      .materials = {},
                      .material_folder = scenario.folder,
                      .lowest_hz = 1e9 * lowest_ghz(scenario.radar),
                      .highest_hz = 1e9 * highest_ghz(scenario.radar),
                      .materials_place = place_of(scenario, path),
                      .frequencies_place = place_of(scenario, path),
                      .mesh_place = place_of(scenario, path + ".mesh")};
  for (std::size_t i = 0; i < spec.part_materials.size(); ++i) {
    const PartMaterialSpec& part = spec.part_materials[i];
    source.materials.push_back(
        {part.part, part.material, place_of(scenario, fmt::format("{}.part_materials.{}.material", path, i))});
  }
  source.materials.push_back({std::nullopt, spec.material, place_of(scenario, path + ".material")});
  if (scale != 1)
    source.loaded = std::make_shared<const TriangleMesh>(enlarged(read_mesh(source.mesh, source.unit), scale));
  return source;
}

// lowest_height_m: of the mesh's origin above the water, of all bodies that have this scatterer.
ScattererSettings scatterer_settings(const Scenario& scenario, const TargetSpec& spec, double lowest_height_m) {
  ScattererSettings settings{
      .waterline_m = std::nullopt,
      .crease_rad = spec.solver.crease_deg ? std::optional(radians(*spec.solver.crease_deg)) : std::nullopt,
      .sheet_thickness_m = 1e-3 * spec.sheet_thickness_mm,
      .edges = spec.solver.edges,
      .lowest_hz = 1e9 * lowest_ghz(scenario.radar),
      .highest_hz = 1e9 * highest_ghz(scenario.radar)};
  // The radar's image illuminates the hull from below. Bodies at several heights are above the water.
  if (scenario.sea_reflection.enabled) settings.waterline_m = -lowest_height_m;
  return settings;
}

// Throws InputError for a target that is entirely under water, if the sea reflects.
void check_above_water(const Scenario& scenario, const TargetSpec& spec, const TriangleMesh& mesh, double height_m) {
  if (!scenario.sea_reflection.enabled) return;
  const double top_m = bounds(mesh).upper.z(), bottom_m = bounds(mesh).lower.z();
  if (spec.layout && spec.layout->heights_m && bottom_m + height_m < 0) {
    throw InputError(fmt::format(
        "{}: its lowest body reaches {:.6g} m below the water: with sea_reflection bodies at several heights must be "
        "above it",
        place_of(scenario, fmt::format("targets.{}.layout.heights", spec.name)), -(bottom_m + height_m)));
  }
  if (top_m + height_m > 0) return;
  if (spec.motion.model == MotionModel::kFloat || is_moving_raft(spec)) {
    throw InputError(fmt::format(
        "{}: value {}: must be greater than {:.6g} with sea_reflection, else the whole target is under water",
        place_of(scenario, fmt::format("targets.{}.motion.origin_above_waterline_m", spec.name)), height_m, -top_m));
  }
  throw InputError(
      fmt::format("{}: its highest point is at z = {:.6g} m: must be above 0, the water, with sea_reflection, else the "
                  "whole target is under water",
                  place_of(scenario, fmt::format("targets.{}.mesh", spec.name)), top_m));
}

// Throws InputError for more sizes of one mesh than memory is expected to hold: up to 2 GB per million triangles.
void check_sizes(const Scenario& scenario, const TargetSpec& spec, std::size_t sizes, const TriangleMesh& mesh) {
  constexpr std::size_t kMostTriangles = 2'000'000;
  if (sizes == 1 || sizes * mesh.triangles.size() <= kMostTriangles) return;
  throw InputError(
      fmt::format("{}: {} bodies of different sizes with {} triangles each: must have at most {} triangles in all",
                  place_of(scenario, fmt::format("targets.{}.layout.scales", spec.name)), sizes, mesh.triangles.size(),
                  kMostTriangles));
}

// The fields of a target that determine its mesh.
TargetSpec enlarged_mesh(const TargetSpec& spec, double scale) {
  TargetSpec alone;
  alone.mesh = spec.mesh;
  alone.unit = spec.unit;
  alone.scale = scale;
  return alone;
}

std::string text_of(const TargetSpec& alone) {
  Scenario scenario;
  scenario.targets = {alone};
  return effective_yaml(scenario);
}

// The fields that determine the motion model of bodies of one size.
std::string motion_fields(const TargetSpec& spec, double scale) {
  TargetSpec alone = enlarged_mesh(spec, moves_by_size(spec) ? scale : 1);
  alone.motion = spec.motion;
  if (is_raft(spec.layout)) alone.layout = LayoutSpec{.line = LineLayout{}, .bodies = LayoutBodies::kRigid};
  return text_of(alone);
}

// Likewise their scatterer; whether bodies are at several heights changes what may be under water.
std::string scatterer_fields(const Scenario& scenario, const TargetSpec& spec, double scale, double lowest_height_m) {
  TargetSpec alone = enlarged_mesh(spec, scale);
  alone.material = spec.material;
  alone.part_materials = spec.part_materials;
  alone.sheet_thickness_mm = spec.sheet_thickness_mm;
  alone.solver = spec.solver;
  const std::string sea = scenario.sea_reflection.enabled ? fmt::format("{} m above the sea, {}", lowest_height_m,
                                                                        spec.layout && spec.layout->heights_m)
                                                          : "";
  return fmt::format("{} to {} GHz {} {}", lowest_ghz(scenario.radar), highest_ghz(scenario.radar), sea,
                     text_of(alone));
}

}  // namespace

Body load_body(const Scenario& scenario, const TargetSpec& spec, const TriangleMesh& mesh) {
  try {
    return make_body(spec.motion,
                     is_raft(spec.layout) ? BodyShape{.box = {}, .hull = {}, .is_raft = true} : shape_of(mesh),
                     scenario.folder);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", place_of(scenario, "targets." + spec.name), error.what()));
  }
}

bool moves_by_size(const TargetSpec& spec) {
  const MotionModel model = spec.motion.model;
  return !is_raft(spec.layout) && (model == MotionModel::kShip || model == MotionModel::kFloat);
}

template <class Value>
template <class Make>
std::shared_ptr<const Value> LoadedBodies::Kept<Value>::get(const std::string& fields, const Make& make) {
  auto known = entries_.find(fields);
  if (known == entries_.end()) known = entries_.emplace(fields, Entry{std::make_shared<const Value>(make())}).first;
  known->second.used = ++calls_;
  std::shared_ptr<const Value> value = known->second.value;
  const auto is_unused = [](const auto& entry) { return entry.second.value.use_count() == 1; };
  if (static_cast<std::size_t>(std::ranges::count_if(entries_, is_unused)) > kKept) {
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (is_unused(*entry) && (oldest == entries_.end() || entry->second.used < oldest->second.used)) oldest = entry;
    }
    if (oldest != entries_.end()) entries_.erase(oldest);
  }
  return value;
}

BodyModel LoadedBodies::model(const Scenario& scenario, const TargetSpec& spec, double scale, double lowest_height_m) {
  std::optional<SolverMesh> read;
  const auto mesh = [&]() -> SolverMesh& {
    if (!read) read = load_solver_mesh(source_of(scenario, spec, scale));
    return *read;
  };
  BodyModel model;
  model.scale = scale;
  model.motion = motions_.get(motion_fields(spec, scale), [&] { return load_body(scenario, spec, mesh().mesh); });
  model.prepared = prepared_.get(scatterer_fields(scenario, spec, scale, lowest_height_m), [&] {
    check_above_water(scenario, spec, mesh().mesh, lowest_height_m);
    return TracedTarget{prepare_target(std::move(mesh()), scatterer_settings(scenario, spec, lowest_height_m)),
                        std::make_shared<SharedTraces>(memory_)};
  });
  model.radius_m = radius_m(model.prepared->mesh);
  return model;
}

std::vector<std::shared_ptr<const BodyModel>> LoadedBodies::models(const Scenario& scenario, const TargetSpec& spec) {
  const std::vector<double> scales = body_scales(spec.layout, spec.scale), heights_m = body_heights_m(spec.layout);
  std::map<double, double> lowest_height_m;  // of the bodies of each size
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const double height_m = rest_height_m(spec) + heights_m[i];
    const auto [size, is_first] = lowest_height_m.emplace(scales[i], height_m);
    if (!is_first) size->second = std::min(size->second, height_m);
  }
  const std::lock_guard lock(mutex_);
  std::map<double, std::shared_ptr<const BodyModel>> by_size;
  for (const auto& [scale, height_m] : lowest_height_m) {
    by_size[scale] = std::make_shared<const BodyModel>(model(scenario, spec, scale, height_m));
    check_sizes(scenario, spec, lowest_height_m.size(), by_size[scale]->prepared->mesh);
  }
  std::vector<std::shared_ptr<const BodyModel>> models;
  for (const double scale : scales) models.push_back(by_size.at(scale));
  return models;
}

}  // namespace seaglint

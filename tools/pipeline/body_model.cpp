// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/body_model.h"

#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/geometry/placement/waterline.h"
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
                      .placement = with_scale(spec, scale),
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
  return source;
}

// height_m: of the mesh's origin above the water; absent where the body does not reach the water.
ScattererSettings scatterer_settings(const Scenario& scenario, const TargetSpec& spec, std::optional<double> height_m) {
  return {.waterline_m = height_m ? std::optional(-*height_m) : std::nullopt,
          .sea_reflects = scenario.sea_reflection.enabled,
          .crease_rad = spec.solver.crease_deg ? std::optional(radians(*spec.solver.crease_deg)) : std::nullopt,
          .sheet_thickness_m = 1e-3 * spec.sheet_thickness_mm,
          .edges = spec.solver.edges,
          .lowest_hz = 1e9 * lowest_ghz(scenario.radar),
          .highest_hz = 1e9 * highest_ghz(scenario.radar)};
}

// Of a body of one size, above its mesh origin, m, with the margin of what counts as in the water surface.
struct HeightsOfBody {
  double bottom_m = 0, top_m = 0, margin_m = 0;
};

// `box` of the turned mesh, neither enlarged nor moved.
HeightsOfBody heights_of(const TargetSpec& spec, const Bounds& box, double scale) {
  const MeshPlacement placement = with_scale(spec, scale);
  const Vec3 offset(placement.offset_m);
  const Bounds body{scale * box.lower + offset, scale * box.upper + offset};
  return {body.lower.z(), body.upper.z(), waterline_margin(body)};
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
TargetSpec mesh_fields(const MeshPlacement& placement, const std::string& mesh) {
  TargetSpec alone;
  static_cast<MeshPlacement&>(alone) = placement;
  alone.mesh = mesh;
  return alone;
}

TargetSpec enlarged_mesh(const TargetSpec& spec, double scale) {
  return mesh_fields(with_scale(spec, scale), spec.mesh);
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

// Likewise their scatterer.
std::string scatterer_fields(const Scenario& scenario, const TargetSpec& spec, double scale,
                             std::optional<double> height_m) {
  TargetSpec alone = enlarged_mesh(spec, scale);
  alone.material = spec.material;
  alone.part_materials = spec.part_materials;
  alone.sheet_thickness_mm = spec.sheet_thickness_mm;
  alone.solver = spec.solver;
  const std::string sea =
      height_m ? fmt::format("{} m above {}", *height_m, scenario.sea_reflection.enabled ? "a mirror" : "the sea") : "";
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

MeshPlacement turned_mesh(const TargetSpec& spec) {
  MeshPlacement turned;
  turned.unit = spec.unit;
  turned.forward = spec.forward;
  turned.up = spec.up;
  return turned;
}

void check_above_water(const Scenario& scenario, const TargetSpec& spec, const Bounds& box) {
  const std::string target = fmt::format("targets.{}", spec.name);
  const std::vector<double> scales = body_scales(spec.layout, spec.scale), heights_m = body_heights_m(spec.layout);
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const double height_m = rest_height_m(spec) + heights_m[i];
    const HeightsOfBody body = heights_of(spec, box, scales[i]);
    const double top_m = body.top_m + height_m, bottom_m = body.bottom_m + height_m;
    const bool has_heights = spec.layout && spec.layout->heights_m;
    if (scenario.sea_reflection.enabled && has_heights && bottom_m < 0) {
      throw InputError(
          fmt::format("{}: its lowest body reaches {:.6g} m below the water: with sea_reflection bodies at several "
                      "heights must be above it",
                      place_of(scenario, target + ".layout.heights"), -bottom_m));
    }
    // A plate in the water surface is not below it.
    if (top_m > body.margin_m || (!scenario.sea_reflection.enabled && bottom_m >= -body.margin_m)) continue;
    if (has_heights) {
      throw InputError(
          fmt::format("{}: body {} reaches up to {:.6g} m above the water: must be above 0, else the whole "
                      "body is under water",
                      place_of(scenario, target + ".layout.heights"), i + 1, top_m));
    }
    if (spec.motion.model == MotionModel::kFloat || is_moving_raft(spec)) {
      throw InputError(fmt::format("{}: value {}: must be greater than {:.6g}, else the whole target is under water",
                                   place_of(scenario, target + ".motion.origin_above_waterline_m"), height_m,
                                   -body.top_m));
    }
    throw InputError(
        fmt::format("{}: its highest point is at z = {:.6g} m: must be above 0, the water, else the whole target is "
                    "under water; offset_m lifts it",
                    place_of(scenario, target + ".mesh"), body.top_m));
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

BodyModel LoadedBodies::model(const Scenario& scenario, const TargetSpec& spec, double scale,
                              std::optional<double> height_m) {
  std::optional<TargetMesh> read;
  const auto mesh = [&]() -> TargetMesh& {
    if (!read) read = load_target_mesh(source_of(scenario, spec, scale));
    return *read;
  };
  BodyModel model;
  model.scale = scale;
  model.motion = motions_.get(motion_fields(spec, scale), [&] { return load_body(scenario, spec, mesh().mesh); });
  model.prepared = prepared_.get(scatterer_fields(scenario, spec, scale, height_m), [&] {
    return prepare_target(std::move(mesh()), scatterer_settings(scenario, spec, height_m));
  });
  model.radius_m = radius_m(model.prepared->mesh);
  return model;
}

std::vector<std::shared_ptr<const BodyModel>> LoadedBodies::models(const Scenario& scenario, const TargetSpec& spec) {
  const std::lock_guard lock(mutex_);
  const std::shared_ptr<const Bounds> box = boxes_.get(text_of(mesh_fields(turned_mesh(spec), spec.mesh)), [&] {
    return bounds(read_placed_mesh(find_mesh(scenario, spec), turned_mesh(spec)));
  });
  check_above_water(scenario, spec, *box);
  const std::vector<double> scales = body_scales(spec.layout, spec.scale), heights_m = body_heights_m(spec.layout);
  // Bodies of one size share a model, unless they are at different heights in the water.
  std::vector<std::pair<double, std::optional<double>>> bodies;  // scale, and height of those in the water
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const double height_m = rest_height_m(spec) + heights_m[i];
    const HeightsOfBody body = heights_of(spec, *box, scales[i]);
    const bool touches = scenario.sea_reflection.enabled ? body.bottom_m + height_m <= body.margin_m
                                                         : body.bottom_m + height_m < -body.margin_m;
    bodies.emplace_back(scales[i], touches ? std::optional(height_m) : std::nullopt);
  }
  std::map<std::pair<double, std::optional<double>>, std::shared_ptr<const BodyModel>> made;
  for (const auto& body : bodies) made[body] = nullptr;
  for (auto& [body, of_body] : made) {
    of_body = std::make_shared<const BodyModel>(model(scenario, spec, body.first, body.second));
    check_sizes(scenario, spec, made.size(), of_body->prepared->mesh);
  }
  std::vector<std::shared_ptr<const BodyModel>> models;
  for (const auto& body : bodies) models.push_back(made.at(body));
  return models;
}

}  // namespace seaglint

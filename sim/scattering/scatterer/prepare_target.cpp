// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/prepare_target.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/placement/mesh_placement.h"
#include "sim/scattering/scatterer/part_materials.h"
#include "sim/scattering/scatterer/target_check.h"
#include "sim/scenario/material_file.h"

namespace seaglint {
namespace {

void append(std::vector<std::string>& sentences, const std::vector<std::string>& more) {
  sentences.insert(sentences.end(), more.begin(), more.end());
}

// Result of `work`; prefixes its error messages with the place.
template <class Work>
auto at_place(const std::string& place, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    if (place.empty()) throw;
    std::vector<std::string> messages = messages_of(error);
    for (std::string& message : messages) message = fmt::format("{}: {}", place, message);
    throw_input_errors(std::move(messages));
  }
}

std::vector<MaterialSpec> choose_materials(const TargetSource& source, TriangleMesh& mesh) {
  MaterialSpec all;
  std::vector<PartMaterial> parts;
  for (const MaterialChoice& choice : source.materials) {
    const MaterialSpec material = find_material(choice.material, source.material_folder, choice.place);
    if (choice.part) {
      parts.push_back({*choice.part, material});
    } else {
      all = material;
    }
  }
  std::vector<MaterialSpec> materials =
      at_place(source.materials_place, [&] { return assign_materials(mesh, all, parts); });
  at_place(source.frequencies_place, [&] { check_frequencies(materials, source.lowest_hz, source.highest_hz); });
  return materials;
}

}  // namespace

SolverMesh load_solver_mesh(const TargetSource& source) {
  SolverMesh target{
      source.loaded ? placed(*source.loaded, source.placement) : read_placed_mesh(source.mesh, source.placement),
      {},
      {}};
  target.materials = choose_materials(source, target.mesh);
  at_place(source.mesh_place, [&] {
    RepairedMesh repaired = diagnose_and_repair(target.mesh);
    target.warnings = diagnostic_messages(repaired.health);
    target.mesh = std::move(repaired.mesh);
    if (target.mesh.triangles.empty()) throw InputError("no triangle has an area: nothing scatters");
    append(target.warnings, check_target(target.mesh, source.lowest_hz));
  });
  return target;
}

PreparedTarget prepare_target(SolverMesh mesh, const ScattererSettings& settings) {
  PreparedTarget target{std::move(mesh.mesh), std::move(mesh.materials), {}, std::move(mesh.warnings), nullptr};
  if (settings.waterline_m) {
    AboveWater above = above_water(target.mesh, *settings.waterline_m);
    target.below = above.below;
    if (settings.sea_reflects) {
      cut_at_sea_level(target.mesh, target.materials, *settings.waterline_m);
    } else {
      target.mesh = std::move(above.mesh);
    }
  }
  target.scatterer =
      std::make_shared<const Scatterer>(target.mesh, target.materials, settings.crease_rad, settings.sheet_thickness_m,
                                        merging_tolerance(settings.highest_hz));
  append(target.warnings, check_edges(*target.scatterer, settings.edges, settings.lowest_hz, settings.highest_hz,
                                      target.mesh.part_names));
  append(target.warnings, check_bars(*target.scatterer, settings.lowest_hz, target.mesh.part_names));
  return target;
}

}  // namespace seaglint

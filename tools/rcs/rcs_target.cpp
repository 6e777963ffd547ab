// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_target.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/waterline.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

namespace {

// Indices of the requested parts. Throws InputError for a part that does not exist or is no perfect conductor, and for
// a selection by anything but parts.
std::vector<int> cavity_parts(const CavityRequest& request, const TriangleMesh& mesh,
                              const std::vector<MaterialSpec>& materials, const ContributionFilter& selection) {
  std::vector<int> indices;
  for (const std::string& name : request.parts) {
    const auto place = std::find(mesh.part_names.begin(), mesh.part_names.end(), name);
    if (place == mesh.part_names.end())
      throw InputError(
          fmt::format("--cavity {}: the mesh has no such part: {}", name, suggestion(name, mesh.part_names)));
    const auto part = static_cast<int>(place - mesh.part_names.begin());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (mesh.triangle_part[t] == part && materials[mesh.triangle_material[t]].kind != SurfaceKind::kPec)
        throw InputError(fmt::format("--cavity {}: its walls must be pec, not {}", name,
                                     mesh.materials[mesh.triangle_material[t]].name));
    }
    if (std::find(indices.begin(), indices.end(), part) == indices.end()) indices.push_back(part);
  }
  for (const auto* selectors : {&selection.included, &selection.excluded}) {
    for (const ContributionSelector& s : *selectors) {
      if (!request.parts.empty() && s.kind != ContributionSelector::Kind::kPart)
        throw InputError("--cavity: cavity contributions have no bounce count or mechanism; select with part=NAME");
    }
  }
  return indices;
}

// Makes cavities of these parts. Throws InputError for a part that is no open cavity at the lowest or the highest
// frequency.
std::vector<NamedCavity> make_cavities(const CavityRequest& request, const TriangleMesh& mesh,
                                       const std::vector<int>& parts, const Scatterer& whole, double lowest_hz,
                                       double highest_hz) {
  std::vector<NamedCavity> cavities;
  for (const int part : parts) {
    const std::string& name = mesh.part_names[static_cast<std::size_t>(part)];
    cavities.push_back(
        {name, part, Cavity(mesh, static_cast<std::size_t>(part), whole, request.patches_per_wavelength), {}});
    double hz = highest_hz;
    try {
      cavities.back().size = cavities.back().cavity.size(2 * kPi * highest_hz / kSpeedOfLight);
      hz = lowest_hz;
      if (lowest_hz < highest_hz) cavities.back().cavity.size(2 * kPi * lowest_hz / kSpeedOfLight);
    } catch (const InputError& error) {
      throw InputError(fmt::format("--cavity {}, {:.6g} GHz: {}", name, 1e-9 * hz, error.what()));
    }
  }
  return cavities;
}

void require_above_water(const SeaUnderTarget& sea, const TriangleMesh& mesh) {
  const double top_m = bounds(mesh).upper.z();
  if (!(top_m + sea.height_m > 0)) {
    throw InputError(
        fmt::format("--origin-height-m: value {}: must be greater than {:.6g}, else the whole target is under water",
                    sea.height_m, -top_m));
  }
}

// Number of meshes with a part of this name.
std::map<std::string, int> files_by_part(const std::vector<TriangleMesh>& meshes) {
  std::map<std::string, int> files;
  for (const TriangleMesh& mesh : meshes) {
    for (const std::string& part : mesh.part_names) ++files[part];
  }
  return files;
}

}  // namespace

void set_target_files(RcsRequest& request, std::span<const GeometryFile> files) {
  request.target = files.front().file;
  request.unit = files.front().unit;
  request.mesh.reset();
  if (files.size() == 1) return;
  std::vector<TriangleMesh> meshes;
  std::string names;
  for (const GeometryFile& file : files) {
    meshes.push_back(read_mesh(file.file, file.unit));
    names += (names.empty() ? "" : " + ") + file.file.filename().string();
  }
  const std::map<std::string, int> in_files = files_by_part(meshes);
  std::map<std::string, int> taken;  // how often a name was given
  TriangleMesh joined;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string stem = files[i].file.stem().string();
    for (std::string& part : meshes[i].part_names) {
      if (in_files.at(part) > 1) part = meshes[i].part_names.size() == 1 ? stem : stem + "." + part;
      if (const int before = taken[part]++; before > 0) part += fmt::format("_{}", before + 1);
    }
    joined.append(meshes[i]);
    for (const std::string& finding : meshes[i].findings)
      joined.findings.push_back(fmt::format("{}: {}", files[i].file.filename().string(), finding));
  }
  request.target = names;
  request.mesh = std::make_shared<TriangleMesh>(welded(joined));
}

void require_above_waterline(const TriangleMesh& mesh, double waterline_m) {
  const Bounds box = bounds(mesh);
  if (!(box.upper.z() > waterline_m + waterline_margin(box)))
    throw InputError(
        fmt::format("--waterline-m: value {}: must be less than {:.6g}, else the whole target is under water",
                    waterline_m, box.upper.z()));
}

PreparedTarget prepare_mesh(const RcsRequest& request) {
  requested_sweep(request);  // throws InputError for a contradictory request
  const auto [lowest, highest] = std::minmax_element(request.frequency_hz.begin(), request.frequency_hz.end());
  TargetMesh mesh = load_target_mesh({.mesh = request.target,
                                      .placement = request,
                                      .loaded = request.mesh,
                                      .materials = request.materials,
                                      .material_folder = "",
                                      .lowest_hz = *lowest,
                                      .highest_hz = *highest,
                                      .materials_place = "--material",
                                      .frequencies_place = "",
                                      .mesh_place = request.target.string(),
                                      .all_conductor = "--material '*=pec'"});
  ScattererSettings settings{
      .waterline_m = request.waterline_m,
      .crease_rad = request.crease_deg ? std::optional(radians(*request.crease_deg)) : std::nullopt,
      .sheet_thickness_m = 1e-3 * request.sheet_thickness_mm,
      .edges = request.edges,
      .lowest_hz = *lowest,
      .highest_hz = *highest};
  if (request.waterline_m) require_above_waterline(mesh.mesh, *request.waterline_m);
  if (request.sea.reflection) {
    require_above_water(request.sea, mesh.mesh);
    settings.waterline_m = -request.sea.height_m;
    settings.sea_reflects = true;
  }
  PreparedTarget target = prepare_target(std::move(mesh), settings);
  const std::string cut = cut_sentence(target.below);
  if (!cut.empty()) target.warnings.push_back(cut);
  return target;
}

RcsTarget select_echoes(const RcsRequest& request, PreparedTarget prepared) {
  const auto [lowest, highest] = std::minmax_element(request.frequency_hz.begin(), request.frequency_hz.end());
  RcsTarget target{std::move(prepared), {}, {}};
  const PreparedTarget& whole = target.prepared;
  target.filter = filter_of(request.selection, whole.mesh, request.max_bounces, request.edges);
  target.filter.cavities = cavity_parts(request.cavities, whole.mesh, whole.materials, target.filter);
  target.cavities =
      make_cavities(request.cavities, whole.mesh, target.filter.cavities, *whole.scatterer, *lowest, *highest);
  return target;
}

RcsTarget prepare_rcs_target(const RcsRequest& request) { return select_echoes(request, prepare_mesh(request)); }

}  // namespace seaglint

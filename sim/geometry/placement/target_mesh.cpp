// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/placement/target_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {

namespace {

Vec3 axis_of(const std::string& word, const char* what) {
  const auto known = std::find(std::begin(kMeshAxes), std::end(kMeshAxes), word);
  if (known == std::end(kMeshAxes))
    throw InputError(fmt::format("{}: value '{}': must be one of {}", what, word, fmt::join(kMeshAxes, ", ")));
  Vec3 axis = Vec3::Zero();
  axis[word[1] - 'x'] = word[0] == '+' ? 1 : -1;
  return axis;
}

// `mesh` of this name in metres.
TriangleMesh placed_near(TriangleMesh mesh, const MeshPlacement& placement, const std::filesystem::path& path) {
  mesh = placed(std::move(mesh), placement);
  const Bounds box = bounds(mesh);
  const double farthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
  if (!(farthest <= kLargestCoordinate))
    throw InputError(fmt::format("{}: reaches {:g} m from the origin, beyond {:g} m: are unit, scale and offset right?",
                                 path.string(), farthest, kLargestCoordinate));
  return mesh;
}

}  // namespace

Mat3 rotation_of(const MeshPlacement& placement) {
  const Vec3 forward = axis_of(placement.forward, "forward"), up = axis_of(placement.up, "up");
  if (forward.dot(up) != 0)
    throw InputError(
        fmt::format("forward {} and up {}: must be perpendicular to each other", placement.forward, placement.up));
  return Mat3(forward, up.cross(forward), up).transpose();
}

TriangleMesh placed(TriangleMesh mesh, const MeshPlacement& placement) {
  const Mat3 rotation = rotation_of(placement);
  const Vec3 offset(placement.offset_m);
  if (rotation != Mat3::Identity()) mesh = transformed(mesh, rotation, Vec3::Zero());
  if (placement.scale != 1) mesh = enlarged(std::move(mesh), placement.scale);
  if (!offset.isZero(0)) mesh = transformed(mesh, Mat3::Identity(), offset);
  return mesh;
}

TriangleMesh read_placed_mesh(const std::filesystem::path& path, const MeshPlacement& placement) {
  return placed_near(read_mesh(path, placement.unit), placement, path);
}

std::string placement_text(const MeshPlacement& placement) {
  const MeshPlacement standard;
  std::string text = "unit " + placement.unit;
  if (placement.forward != standard.forward || placement.up != standard.up)
    text += fmt::format(" forward {} up {}", placement.forward, placement.up);
  if (placement.scale != standard.scale) text += fmt::format(" scale {:.9g}", placement.scale);
  if (placement.offset_m != standard.offset_m)
    text += fmt::format(" offset_m {:.9g}", fmt::join(placement.offset_m, ","));
  return text;
}

MeshPlacement with_scale(MeshPlacement placement, double scale) {
  for (double& along : placement.offset_m) along *= scale / placement.scale;
  placement.scale = scale;
  return placement;
}

std::vector<MaterialSpec> assign_materials(TriangleMesh& mesh, const MaterialSpec& all,
                                           std::span<const PartMaterial> parts) {
  std::vector<MaterialSpec> materials{all};
  // Number of the last entry that applies.
  std::vector<std::uint16_t> of_part(mesh.part_names.size(), 0), of_file_material(mesh.materials.size(), 0);
  for (const PartMaterial& entry : parts) {
    const bool prefix = entry.part.ends_with('*');
    const std::string name = prefix ? entry.part.substr(0, entry.part.size() - 1) : entry.part;
    const auto number = static_cast<std::uint16_t>(materials.size());
    const auto applies = [&](const std::string& other, std::uint16_t& last) {
      const bool matches = prefix ? other.starts_with(name) : other == name;
      if (matches) last = number;
      return matches;
    };
    // A mesh without parts has faces, too.
    bool found = prefix && name.empty(), found_material = false;
    if (found) of_file_material.assign(std::max<std::size_t>(1, of_file_material.size()), number);
    for (std::size_t part = 0; part < of_part.size(); ++part)
      found = applies(mesh.part_names[part], of_part[part]) || found;
    // Faces without a material of their own have the default's name.
    for (std::size_t m = 0; !found && m < of_file_material.size(); ++m) {
      if (mesh.materials[m].name != Material{}.name)
        found_material = applies(mesh.materials[m].name, of_file_material[m]) || found_material;
    }
    if (!found && !found_material) {
      throw InputError(
          fmt::format("part '{}': the mesh has no such part: {}", entry.part, suggestion(entry.part, mesh.part_names)));
    }
    materials.push_back(entry.material);
  }
  mesh.materials.clear();
  for (const MaterialSpec& material : materials) mesh.materials.push_back({material.name});
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint16_t& material = mesh.triangle_material[t];
    material = material < of_file_material.size() ? of_file_material[material] : std::uint16_t{0};
    if (t < mesh.triangle_part.size()) material = std::max(material, of_part[mesh.triangle_part[t]]);
  }
  return materials;
}

std::vector<std::string> assign_own_materials(TriangleMesh& mesh, std::vector<MaterialSpec>& materials,
                                              const TriangleMesh& before, const std::filesystem::path& folder) {
  std::vector<std::string> names;
  // Number of the material in `materials`, by its number in the mesh; 0: none.
  std::vector<std::optional<std::uint16_t>> number(before.materials.size());
  for (std::size_t t = 0; t < before.triangle_material.size(); ++t) {
    if (mesh.triangle_material[t] != 0) continue;
    const std::size_t own = before.triangle_material[t];
    if (!number[own]) {
      number[own] = 0;
      if (const auto material = known_material(before.materials[own].name, folder)) {
        number[own] = static_cast<std::uint16_t>(materials.size());
        names.push_back(before.materials[own].name);
        materials.push_back(*material);
        mesh.materials.push_back({materials.back().name});
      }
    }
    mesh.triangle_material[t] = *number[own];
  }
  return names;
}

void cut_at_sea_level(TriangleMesh& mesh, std::vector<MaterialSpec>& materials, double height) {
  WaterlineCut cut = cut_at_waterline(mesh, height);
  mesh = std::move(cut.mesh);
  MaterialSpec water;
  water.name = "under_water";
  water.kind = SurfaceKind::kSubmerged;
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < cut.submerged.size(); ++t) {
    if (cut.submerged[t]) mesh.triangle_material[t] = static_cast<std::uint16_t>(materials.size());
  }
  mesh.materials.push_back({water.name});
  materials.push_back(water);
}

void check_frequencies(std::span<const MaterialSpec> materials, double lowest_hz, double highest_hz) {
  for (const MaterialSpec& material : materials) {
    if (lowest_hz < 1e9 * material.lowest_ghz || highest_hz > 1e9 * material.highest_ghz) {
      throw InputError(fmt::format("material {}: its source covers {} to {} GHz, asked for {:.6g} to {:.6g} GHz",
                                   material.name, material.lowest_ghz, material.highest_ghz, 1e-9 * lowest_hz,
                                   1e-9 * highest_hz));
    }
  }
}

// Smallest size in wavelengths: physical optics of a plate this wide has an error of 1 dB at normal incidence.
constexpr double kMinWavelengths = 3;
constexpr double kLongestTarget_m = 5e3;  // ten times the longest ships
// Half-sizes from the origin, warning and error: the echo is exact there too, but such a centre of rotation is hardly
// meant.
constexpr double kFarOrigin = 10, kTooFarOrigin = 300;
constexpr std::size_t kManyTriangles = 1'000'000;
// Memory and time per million triangles on two cores: of a sphere, whose facets are merged, and of one with noise of
// half a side, whose edges are all sharp.
constexpr double kGigabytesOfSmooth = 0.4, kGigabytesOfSharp = 2;
constexpr double kSecondsToBuild = 8, kSecondsOfSmooth = 0.1, kSecondsOfSharp = 22;

std::vector<std::string> check_target(const TriangleMesh& mesh, double lowest_hz) {
  std::vector<std::string> found;
  const Bounds box = bounds(mesh);
  const Vec3 size = box.upper - box.lower, centre = (box.upper + box.lower) / 2;
  const double longest = size.norm(), wavelength = kSpeedOfLight / lowest_hz;
  if (longest > kLongestTarget_m)
    found.push_back(fmt::format("the target is {:.4g} m across; is its unit right?", longest));
  if (longest < kMinWavelengths * wavelength) {
    found.push_back(fmt::format(
        "the target is {:.3g} m across, {:.3g} wavelengths at {:g} GHz; physical optics needs {:g} and more{}", longest,
        longest / wavelength, lowest_hz * 1e-9, kMinWavelengths, longest < 0.01 ? "; is its unit right?" : ""));
  }

  const double distance = centre.norm() / std::max(longest / 2, 1e-300);
  if (distance > kTooFarOrigin) {
    throw InputError(
        fmt::format("the target of {:.4g} m is centred {:.4g} m from the origin, its centre of rotation and phase "
                    "centre: translate the mesh (offset_m, --offset-m)",
                    longest, centre.norm()));
  }
  if (distance > kFarOrigin)
    found.push_back(
        fmt::format("the target of {:.4g} m is centred {:.4g} m from the origin, its centre of rotation and phase "
                    "centre",
                    longest, centre.norm()));

  if (mesh.triangles.size() > kManyTriangles) {
    const double millions = 1e-6 * static_cast<double>(mesh.triangles.size());
    const auto of_all = [&](double per_million) { return std::ceil(per_million * millions); };
    found.push_back(fmt::format(
        "{:.1f} million triangles: expect {:.0f} to {:.0f} GB of memory, the more the more of its edges are "
        "sharp, about {:.0f} s before the first view and {:.0f} to {:.0f} s for every view",
        millions, of_all(kGigabytesOfSmooth), of_all(kGigabytesOfSharp), of_all(kSecondsToBuild),
        of_all(kSecondsOfSmooth), of_all(kSecondsOfSharp)));
  }
  return found;
}

namespace {

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

// The target with its materials and the note on those of its mesh.
void choose_materials(const TargetSource& source, TargetMesh& target) {
  MaterialSpec all;
  std::vector<PartMaterial> parts;
  bool is_whole_chosen = false;
  for (const MaterialChoice& choice : source.materials) {
    const MaterialSpec material = find_material(choice.material, source.material_folder, choice.place);
    if (choice.part) {
      parts.push_back({*choice.part, material});
    } else {
      all = material;
      is_whole_chosen = true;
    }
  }
  TriangleMesh before;  // without its faces
  before.materials = target.mesh.materials, before.triangle_material = target.mesh.triangle_material;
  std::vector<std::string> own;
  at_place(source.materials_place, [&] {
    target.materials = assign_materials(target.mesh, all, parts);
    if (!is_whole_chosen) own = assign_own_materials(target.mesh, target.materials, before, source.material_folder);
  });
  const std::span<const MaterialSpec> materials = target.materials;
  const std::size_t chosen = materials.size() - own.size();
  at_place(source.frequencies_place, [&] {
    check_frequencies(materials.first(chosen), source.lowest_hz, source.highest_hz);
    try {
      check_frequencies(materials.subspan(chosen), source.lowest_hz, source.highest_hz);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}; the mesh names it: {} makes every face a perfect conductor", error.what(),
                                   source.all_conductor));
    }
  });
  if (!own.empty())
    target.materials_note = fmt::format("materials as the mesh names them: {}; {} makes every face a perfect conductor",
                                        fmt::join(own, ", "), source.all_conductor);
}

}  // namespace

TargetMesh load_target_mesh(const TargetSource& source) {
  TargetMesh target{placed_near(source.loaded ? *source.loaded : read_mesh(source.mesh, source.placement.unit),
                                source.placement, source.mesh),
                    {},
                    {},
                    {}};
  choose_materials(source, target);
  at_place(source.mesh_place, [&] {
    RepairedMesh repaired = diagnose_and_repair(target.mesh);
    target.warnings = diagnostic_messages(repaired.health);
    target.mesh = std::move(repaired.mesh);
    if (target.mesh.triangles.empty()) throw InputError("no triangle has an area: nothing scatters");
    const std::vector<std::string> more = check_target(target.mesh, source.lowest_hz);
    target.warnings.insert(target.warnings.end(), more.begin(), more.end());
  });
  return target;
}

}  // namespace seaglint

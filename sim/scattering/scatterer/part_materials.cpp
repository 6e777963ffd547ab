// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/part_materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/process/error.h"
#include "sim/core/text/suggestion.h"
#include "sim/geometry/placement/waterline.h"

namespace seaglint {

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
    bool found = false, found_material = false;
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

}  // namespace seaglint

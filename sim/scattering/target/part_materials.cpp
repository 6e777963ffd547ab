// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/part_materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/process/error.h"
#include "sim/core/text/suggestion.h"
#include "sim/geometry/mesh/waterline.h"

namespace seaglint {

std::vector<MaterialSpec> assign_materials(TriangleMesh& mesh, const MaterialSpec& all,
                                           std::span<const PartMaterial> parts) {
  std::vector<MaterialSpec> materials{all};
  std::vector<std::uint16_t> of_part(mesh.part_names.size(), 0);
  for (const PartMaterial& entry : parts) {
    const bool prefix = entry.part.ends_with('*');
    const std::string name = prefix ? entry.part.substr(0, entry.part.size() - 1) : entry.part;
    bool found = false;
    for (std::size_t part = 0; part < mesh.part_names.size(); ++part) {
      if (prefix ? !mesh.part_names[part].starts_with(name) : mesh.part_names[part] != name) continue;
      of_part[part] = static_cast<std::uint16_t>(materials.size());
      found = true;
    }
    if (!found) {
      throw InputError(
          fmt::format("part '{}': the mesh has no such part: {}", entry.part, suggestion(entry.part, mesh.part_names)));
    }
    materials.push_back(entry.material);
  }
  mesh.materials.clear();
  for (const MaterialSpec& material : materials) mesh.materials.push_back({material.name});
  mesh.triangle_material.assign(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t < mesh.triangle_part.size()) mesh.triangle_material[t] = of_part[mesh.triangle_part[t]];
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

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_cavities.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/text/suggestion.h"

namespace seaglint {

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

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cli/cavity_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/standard_error.h"
#include "sim/core/process/error.h"
#include "sim/core/text/suggestion.h"
#include "tools/cli/command.h"

namespace seaglint {

void CavityArguments::add_to(CLI::App& command) {
  command
      .add_option("--cavity", parts,
                  "Part of the mesh that is the walls of a cavity with an open mouth, some wavelengths wide: its echo "
                  "from the field inside (integral "
                  "equation) instead of rays; minutes per frequency (repeatable)")
      ->type_name("PART")
      ->allow_extra_args(false);
  command
      .add_option("--cavity-patches", patches_per_wavelength,
                  "Patches of its walls per wavelength: time goes with the fourth power")
      ->check(number_within(4.0, 20.0))
      ->capture_default_str()
      ->needs("--cavity");
}

std::vector<int> CavityArguments::find(const TriangleMesh& mesh, const std::vector<MaterialSpec>& materials,
                                       const EchoFilter& selection) const {
  std::vector<int> indices;
  for (const std::string& name : parts) {
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
  for (const auto* selectors : {&selection.only, &selection.without}) {
    for (const EchoSelector& s : *selectors) {
      if (wanted() && s.kind != EchoSelector::Kind::kPart)
        throw InputError(
            "--cavity: what comes out of a cavity has neither bounces nor a mechanism; select by part=NAME");
    }
  }
  return indices;
}

std::vector<NamedCavity> CavityArguments::make(const TriangleMesh& mesh, const std::vector<int>& indices,
                                               const Scatterer& whole, double lowest_hz, double highest_hz) const {
  std::vector<NamedCavity> cavities;
  for (const int part : indices) {
    const std::string& name = mesh.part_names[static_cast<std::size_t>(part)];
    cavities.push_back({name, part, Cavity(mesh, static_cast<std::size_t>(part), whole, patches_per_wavelength)});
    double hz = highest_hz;
    try {
      const CavitySize size = cavities.back().cavity.size(2 * kPi * highest_hz / kSpeedOfLight);
      hz = lowest_hz;
      if (lowest_hz < highest_hz) cavities.back().cavity.size(2 * kPi * lowest_hz / kSpeedOfLight);
      print_error(fmt::format("cavity {}: mouth of {:.4g} m^2, walls of {:.4g} m^2, {} patches at {:.6g} GHz\n", name,
                              size.mouth_m2, size.walls_m2, size.patches, 1e-9 * highest_hz));
    } catch (const InputError& error) {
      throw InputError(fmt::format("--cavity {}, {:.6g} GHz: {}", name, 1e-9 * hz, error.what()));
    }
  }
  return cavities;
}

std::string CavityArguments::text() const {
  if (!wanted()) return "";
  return fmt::format(
      "# cavities {}: from the currents on their walls (magnetic-field integral equation, {:.6g} patches per "
      "wavelength), fed through their mouths\n",
      fmt::join(parts, " "), patches_per_wavelength);
}

}  // namespace seaglint

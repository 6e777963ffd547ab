// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cli/sea_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "sim/core/process/error.h"
#include "tools/cli/command.h"

namespace seaglint {

void SeaArguments::add_to(CLI::App& command) {
  CLI::Option* sea = command.add_flag(
      "--sea-reflection", reflection,
      "Four ways between radar and target: direct and by the mean sea surface; elevations must be above 0");
  command.add_option("--height-m", height_m, "Height of the mesh's origin above the mean sea surface")
      ->check(number_within(-1e4, 1e4))
      ->capture_default_str()
      ->needs(sea);
  command.add_option("--wave-height-m", wave_height_m, "Significant wave height: roughness of the mirror")
      ->check(number_within(0.0, 30.0))
      ->capture_default_str()
      ->needs(sea);
  command.add_option("--sea-surface", surface, "sea_water (20 deg C, 35 psu) or conductor")
      ->check(CLI::IsMember({"sea_water", "conductor"}))
      ->capture_default_str()
      ->needs(sea);
  command.add_option("--sea-paths", paths, "all, direct or multipath")
      ->check(CLI::IsMember({"all", "direct", "multipath"}))
      ->capture_default_str()
      ->needs(sea);
}

SeaMirror SeaArguments::mirror() const {
  SeaReflectionSpec spec;
  spec.surface = surface == "conductor" ? SeaSurface::kConductor : SeaSurface::kSeaWater;
  spec.paths = paths == "multipath" ? SeaPaths::kMultipath : paths == "direct" ? SeaPaths::kDirect : SeaPaths::kAll;
  return SeaMirror(spec, wave_height_m);
}

void SeaArguments::check(std::span<const double> elevation_deg, std::span<const double> frequency_hz) const {
  if (!reflection) return;
  for (const double elevation : elevation_deg) {
    if (elevation <= 0)
      throw InputError(
          fmt::format("--elevation-deg: value {}: must be greater than 0 with --sea-reflection", elevation));
  }
  for (const double frequency : frequency_hz) {
    if (surface == "sea_water" && frequency > 90e9) {
      throw InputError(fmt::format("--frequency-ghz: value {}: must be at most 90 with --sea-reflection over sea_water",
                                   1e-9 * frequency));
    }
  }
}

void SeaArguments::check(const TriangleMesh& mesh) const {
  const double top_m = bounds(mesh).upper.z();
  if (!(top_m + height_m > 0)) {
    throw InputError(fmt::format(
        "--height-m: value {}: must be greater than {:.6g}, else the whole target is under water", height_m, -top_m));
  }
}

std::string SeaArguments::text() const {
  if (!reflection) return "";
  return fmt::format("# over {}, origin {:.6g} m above the mean surface, significant wave height {:.6g} m, paths {}\n",
                     surface, height_m, wave_height_m, paths);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sea under a target at rest, as options of a command.

#include <CLI/App.hpp>
#include <span>
#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/response/sea_reflection.h"

namespace seaglint {

struct SeaArguments {
  bool reflection = false;
  double height_m = 0;       // of the mesh's origin above the mean surface
  double wave_height_m = 0;  // significant
  std::string surface = "sea_water", paths = "all";

  void add_to(CLI::App& command);
  SeaMirror mirror() const;
  // Throws InputError for a direction without an image, and for frequencies beyond the model of sea water.
  void check(std::span<const double> elevation_deg, std::span<const double> frequency_hz) const;
  // Throws InputError where the whole mesh lies under water.
  void check(const TriangleMesh& mesh) const;
  // A comment line for the head of a table; empty without the sea.
  std::string text() const;
};

}  // namespace seaglint

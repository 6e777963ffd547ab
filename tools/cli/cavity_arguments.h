// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The option of `rcs` that names parts whose echo is found from the field inside them.

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "sim/cavity/cavity_scattering.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/beams/contribution_filter.h"
#include "sim/scattering/material/material.h"

namespace seaglint {

struct NamedCavity {
  std::string name;
  int part = 0;
  Cavity cavity;
};

struct CavityArguments {
  std::vector<std::string> parts;
  double patches_per_wavelength = kPatchesPerWavelength;

  void add_to(CLI::App& command);
  bool wanted() const { return !parts.empty(); }
  // Their indices. Throws InputError for a part that is not there or no perfect conductor, and for a selection by
  // anything but parts.
  std::vector<int> find(const TriangleMesh& mesh, const std::vector<MaterialSpec>& materials,
                        const EchoFilter& selection) const;
  // Those parts of the mesh as cavities; says their sizes. Throws InputError for what is none at the lowest or the
  // highest frequency.
  std::vector<NamedCavity> make(const TriangleMesh& mesh, const std::vector<int>& indices, const Scatterer& whole,
                                double lowest_hz, double highest_hz) const;
  // A comment line for the head of a table; empty without cavities.
  std::string text() const;
};

}  // namespace seaglint

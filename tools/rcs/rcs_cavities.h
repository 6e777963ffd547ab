// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Parts of a mesh that are solved as open cavities instead of by beam tracing.

#include <string>
#include <vector>

#include "sim/cavity/cavity_scattering.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

struct NamedCavity {
  std::string name;
  int part = 0;
  Cavity cavity;
  CavitySize size;  // at the highest frequency
};

// Indices of the requested parts. Throws InputError for a part that does not exist or is no perfect conductor, and for
// a selection by anything but parts.
std::vector<int> cavity_parts(const CavityRequest& request, const TriangleMesh& mesh,
                              const std::vector<MaterialSpec>& materials, const ContributionFilter& selection);

// Makes cavities of these parts. Throws InputError for a part that is no open cavity at the lowest or the highest
// frequency.
std::vector<NamedCavity> make_cavities(const CavityRequest& request, const TriangleMesh& mesh,
                                       const std::vector<int>& parts, const Scatterer& whole, double lowest_hz,
                                       double highest_hz);

}  // namespace seaglint

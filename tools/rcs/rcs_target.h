// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Target of a request: its mesh with materials, scatterer, open cavities.

#include <span>
#include <string>
#include <vector>

#include "sim/cavity/cavity_scattering.h"
#include "sim/field_tables/field_table.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

// Parts of a mesh that are solved as open cavities instead of by beam tracing.

struct NamedCavity {
  std::string name;
  int part = 0;
  Cavity cavity;
  CavitySize size;  // at the highest frequency
};

// Prepared target of a request.
struct RcsTarget {
  PreparedTarget prepared;
  ContributionFilter filter;  // contributions that are summed
  std::vector<NamedCavity> cavities;
};

// Makes mesh files, each in its unit, the request's target: one of them as it is, several as one scatterer. A part has
// its name; where that is in several files, its file's name, of a file of several parts FILE.PART. At least one file.
// Throws what read_mesh() throws.
void set_target_files(RcsRequest& request, std::span<const GeometryFile> files);

// Throws InputError where the whole mesh is below z = waterline_m (--waterline-m).
void require_above_waterline(const TriangleMesh& mesh, double waterline_m);

// Reads and prepares the request's mesh; its `warnings` are the warnings for the user. Throws InputError for a mesh or
// material that is missing or invalid, for a contradictory request, and for a mesh that is entirely under water.
PreparedTarget prepare_mesh(const RcsRequest& request);

// The prepared mesh with the request's selection and cavities. Throws InputError for a selection or cavity that does
// not fit the mesh.
RcsTarget select_echoes(const RcsRequest& request, PreparedTarget prepared);

// prepare_mesh() followed by select_echoes().
RcsTarget prepare_rcs_target(const RcsRequest& request);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/rcs/rcs_cavities.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

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

// Reads and prepares the request's mesh; its `warnings` are the warnings for the user. Throws InputError for a mesh or
// material that is missing or invalid, for a contradictory request, and for a mesh that is entirely under water.
PreparedTarget prepare_mesh(const RcsRequest& request);

// The prepared mesh with the request's selection and cavities. Throws InputError for a selection or cavity that does
// not fit the mesh.
RcsTarget select_echoes(const RcsRequest& request, PreparedTarget prepared);

// prepare_mesh() followed by select_echoes().
RcsTarget prepare_rcs_target(const RcsRequest& request);

}  // namespace seaglint

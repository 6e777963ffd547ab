// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/scattering/beams/contribution_filter.h"
#include "sim/scattering/target/prepare_target.h"
#include "tools/rcs/rcs_cavities.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

// The target of a request, ready to be computed.
struct RcsTarget {
  PreparedTarget prepared;
  ContributionFilter filter;  // which echoes are summed
  std::vector<NamedCavity> cavities;
};

// Reads and prepares the request's mesh; doubts says what a user should know of it. Throws InputError for a mesh or
// material that is missing or unsound, for a request that contradicts itself, and where the whole mesh lies under
// water.
PreparedTarget prepare_mesh(const RcsRequest& request);

// The prepared mesh with the request's selection and cavities. Throws InputError for either that does not fit it.
RcsTarget select_echoes(const RcsRequest& request, PreparedTarget prepared);

// Both.
RcsTarget prepare_rcs_target(const RcsRequest& request);

}  // namespace seaglint

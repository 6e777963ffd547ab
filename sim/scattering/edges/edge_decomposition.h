// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The phase integral along a stretch of edge as points that hold over a band and a small turn.

#include <vector>

#include "sim/scattering/edges/edge_contribution.h"
#include "sim/scattering/surfaces/point_contributions.h"

namespace seaglint {

// The contributions of a stretch of edge at kc, appended: its ends, or pieces short enough for one point, as for a
// footprint.
void split(const EdgeContribution& contribution, const DecompositionSettings& settings,
           std::vector<PointContribution>& out);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Decomposes the phase integral along an interval of an edge into points that hold over a band and a small aspect
// change.

#include <vector>

#include "sim/scattering/edges/edge_contribution.h"
#include "sim/scattering/surfaces/point_contributions.h"

namespace seaglint {

// Appends the point contributions of an edge contribution at kc: its two end points, or pieces short enough for one
// point each, by the criteria of decompose() for footprints.
void decompose(const EdgeContribution& contribution, const DecompositionSettings& settings,
               std::vector<PointContribution>& out);

}  // namespace seaglint

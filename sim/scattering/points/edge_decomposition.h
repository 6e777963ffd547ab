// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Decomposes the phase integral along an interval of an edge into points that hold over a band and a small aspect
// change.

#include <vector>

#include "sim/scattering/points/point_contributions.h"
#include "sim/scattering/radiation/edge_contribution.h"

namespace seaglint {

// Appends the point contributions of an edge contribution at kc: its two end points, or pieces short enough for one
// point each, by the criteria of decompose() for footprints.
void decompose(const EdgeContribution& contribution, const DecompositionSettings& settings,
               std::vector<PointContribution>& out);

// The same with the amplitudes at the nodes of a band, for a sweep; the patterns, contribution.pattern at the nodes,
// are not set. Without an aspect change pieces are only as short as the width of the band requires.
void decompose(const EdgeContribution& contribution, const FrequencyBand& band, double aspect_change_rad,
               std::vector<BandPoint>& out);

// False where the amplitude law oscillates over the band, so that its nodes do not determine it.
bool varies_slowly(const EdgeContribution& contribution, const FrequencyBand& band);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Level of noise, clutter and residual pedestal at every cell of a range-velocity map without its centres.

#include <cstddef>
#include <vector>

#include "radar/rvmap/rv_map.h"

namespace seaglint {

// Shorter rows or columns have no level of their own: the quantile could be a target's cell.
inline constexpr std::size_t kMinCells = 8;

// Mean power of the residual at every cell, [velocity][range], estimated so that a few centres do not raise it. The
// three causes differ in shape: noise is flat, clutter a ridge along range at its Doppler, pedestals lie along velocity
// at their range. Their powers add: the level of a cell is the largest of the map's, its column's and its row's level
// and of column + row - map; each from a quantile of |RV|^2, scaled to the mean of an exponential distribution.
std::vector<double> residual_floor(const RvMap& residual);

// Threshold relative to the mean power that noise exceeds in 1 % of maps: exponential |RV|^2 in `cells` independent
// cells.
double threshold_factor(double cells);

}  // namespace seaglint

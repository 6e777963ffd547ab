// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a range-velocity map holds besides its centres: noise, clutter and residual pedestal, as one level per cell.

#include <cstddef>
#include <vector>

#include "radar/rvmap/rv_map.h"

namespace seaglint {

// A line of fewer cells tells no level: its quantile may be a target's own cell.
inline constexpr std::size_t kMinCells = 8;

// Mean power of the residual at every cell, [velocity][range], estimated so that a few centres do not raise it. The
// three causes differ in shape: noise is flat, clutter a ridge along range at its Doppler, pedestals lie along velocity
// at their range. So the level of a cell is the largest of the map's, its column's and its row's, and of column x row /
// map (a ridge whose strength varies with range); each from a quantile of |RV|^2, scaled to the mean of an exponential
// distribution.
std::vector<double> residual_floor(const RvMap& residual);

// Factor on the floor's power that noise passes in one map out of a hundred: exponential |RV|^2 in `cells` independent
// cells.
double threshold_factor(double cells);

}  // namespace seaglint

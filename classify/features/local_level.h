// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which of the points that CLEAN took out are centres, and which are the crests of clutter: each is held against what
// its own surroundings in the map hold besides points.

#include <span>
#include <vector>

#include "classify/features/residual_echo.h"
#include "radar/rvmap/rv_map.h"

namespace seaglint {

// Sizes that a judgement needs: of a resolution cell, of a point's main lobe and of the map's cells.
struct CellSizes {
  double range_m = 1;                                        // c / (2 B_s)
  double velocity_mps = 1;                                   // lambda / (2 N T_r)
  double range_oversampling = 1, velocity_oversampling = 1;  // cells of the map per resolution cell
  double lobe_cells = 1;  // power that a point of amplitude 1 spreads over the resolution cells of its lobe
};

// One answer for each of `points`: whether it is at least `least_power`, and `factor` times the level it is seen
// against: residual_floor at its cell, or, where that is more, the mean of its surroundings (5 velocities x 13
// ranges) times a margin for textured clutter. A point that fails is part of what it stood in, and its power returns to
// the level of the others. Surroundings that hold little but points keep to residual_floor (README.md).
std::vector<bool> exceeds_local_level(std::span<const CleanComponent> points, const RvMap& residual,
                                      const std::vector<double>& floor, double factor, double min_power,
                                      const CellSizes& cells);

// What K-distributed clutter of this shape exceeds as often as exponential clutter of the same mean exceeds `factor`
// times the mean, again in units of `factor`; 0.5 <= shape <= 100, 5 <= factor <= 30 to 1e-6.
double texture_threshold_margin(double shape, double factor);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Separates scattering centres from clutter peaks among the CLEAN components, by comparing each with the mean residual
// power around it.

#include <span>
#include <vector>

#include "classify/features/residual_echo.h"
#include "radar/rvmap/rv_map.h"

namespace seaglint {

// Sizes of a resolution cell, of a point's main lobe and of the map's cells.
struct CellSizes {
  double range_m = 1;                                        // c / (2 B_s)
  double velocity_mps = 1;                                   // lambda / (2 N T_r)
  double range_oversampling = 1, velocity_oversampling = 1;  // cells of the map per resolution cell
  double lobe_cells = 1;  // power of a point of amplitude 1, summed over the resolution cells of its main lobe
};

// For each of `points`: true if its power is at least `min_power` and at least `factor` times its local level, the
// larger of residual_floor at its cell and the mean of its surroundings (5 velocities x 13 ranges) times a margin for
// textured clutter. The power of a rejected point is returned to the surroundings of the others. Where accepted points
// dominate their surroundings, residual_floor alone applies (README.md).
std::vector<bool> exceeds_local_level(std::span<const CleanComponent> points, const RvMap& residual,
                                      const std::vector<double>& floor, double factor, double min_power,
                                      const CellSizes& cells);

// Ratio of thresholds of equal false-alarm probability in K-distributed clutter of this shape and in exponential
// clutter of the same mean, whose threshold is `factor` times the mean; accurate to 1e-6 for 0.5 <= shape <= 100, 5 <=
// factor <= 30.
double texture_threshold_margin(double shape, double factor);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Separates scattering centres from clutter peaks among the CLEAN components, by comparing each with the residual power
// around it and with the clutter of all ranges.

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
  // power of a point of amplitude 1, summed over the resolution cells of each axis
  double lobe_ranges = 1, lobe_velocities = 1;
};

// For each of `points`: true if its power is at least `min_power` and at least `factor` times its level. The level is
// residual_floor at its cell where accepted points dominate its surroundings, else the larger of that and of the
// clutter ridge's level in 11 velocities x 11 ranges around it times a margin for textured clutter; but the ridge never
// counts more than its level at the 90 % quantile of all ranges (README.md). The power of a rejected point is returned
// to the surroundings of the others.
std::vector<bool> exceeds_local_level(std::span<const CleanComponent> points, const RvMap& residual,
                                      const std::vector<double>& floor, double factor, double min_power,
                                      const CellSizes& cells);

// Ratio of thresholds of equal false-alarm probability in K-distributed clutter of this shape and in exponential
// clutter of the same mean, whose threshold is `factor` times the mean; accurate to 1e-6 for 0.5 <= shape <= 100, 5 <=
// factor <= 30.
double texture_threshold_margin(double shape, double factor);

}  // namespace seaglint

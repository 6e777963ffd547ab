// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figure of a range-velocity map.

#include <span>
#include <string>

#include "classify/features/scattering_centres.h"
#include "radar/rvmap/rv_map.h"
#include "tools/figure/figure.h"

namespace seaglint {

// |RV| in dB relative to its peak, down to floor_db (< 0), with the scattering centres as circles.
Heatmap rv_figure(const RvMap& map, std::span<const ScatteringCentre> centres, const std::string& title,
                  double floor_db = -40);

}  // namespace seaglint

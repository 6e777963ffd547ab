// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A cross-check of two methods as curves.

#include "tools/cross_check/rcs_cross_check.h"
#include "tools/figure/figure.h"

namespace seaglint {

// Levels of hh and vv by both methods along the axis, azimuth or elevation, that has several values, and below them the
// relative difference of the fields. No plots where both axes vary, or none.
PlotPanels cross_check_plots(const CrossCheck& check);

}  // namespace seaglint

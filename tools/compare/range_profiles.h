// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Range profiles of amplitudes over frequency, side by side.

#include <span>
#include <vector>

#include "tools/figure/figure.h"
#include "tools/rcs/paired_cut.h"

namespace seaglint {

struct RangeProfile {
  std::vector<double> range_m;  // from the phase origin along the bisector of both directions, positive = farther
  std::vector<double> level_dbsm;
};

// |sum_f w_f S_f e^{+j q R}|^2 4 pi with Hann's window of mean 1, q = 2 k cos(beta / 2) the length of the path
// gradient: a point scatterer has its own level. Over the unambiguous range 2 pi / step of q, four values per
// resolution cell. At least 8 uniform steps of frequency (within a hundredth of a step), else empty.
RangeProfile range_profile(std::span<const PairedCut::Place> places, std::span<const Complex> amplitude_m);

// The profile's level at one range (m), of any frequencies.
double level_at_range(std::span<const PairedCut::Place> places, std::span<const Complex> amplitude_m, double range_m);

// Those of export and compared values for the first four cuts over frequency that have phases; empty if none does.
PlotPanels range_profile_plots(std::span<const PairedCut> cuts);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Lobes, nulls and range profiles of curves.

#include <cstddef>
#include <span>
#include <vector>

#include "tools/compare/paired_cut.h"
#include "tools/figure/figure.h"

namespace seaglint {

struct Extremum {
  double x = 0, level_db = 0;  // of the parabola through the three values
};

// Local maxima (lobes) or minima (nulls) of levels over ascending x that differ from the extrema beside them by at
// least 3 dB, above lowest_db. Uneven steps are allowed.
std::vector<Extremum> lobes_of(std::span<const double> x, std::span<const double> level_db, double lowest_db);
std::vector<Extremum> nulls_of(std::span<const double> x, std::span<const double> level_db, double lowest_db);

// Extrema of the reference with the nearest one of the other curve, nearer to it than to any other of the reference.
struct ExtremumPairs {
  std::size_t count = 0;  // of the reference
  std::size_t paired = 0;
  double mean_shift = 0;  // mean of |x - x_reference|, in the unit of x
  double mean_db = 0;     // mean of |level - level_reference|
};
ExtremumPairs paired_extrema(std::span<const Extremum> reference, std::span<const Extremum> other);

// Range profiles of amplitudes over frequency, side by side.

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

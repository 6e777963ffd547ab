// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Lobes and nulls of a cut, and how far those of two curves lie apart.

#include <cstddef>
#include <span>
#include <vector>

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

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Smooth and linear transitions between two values.

#include <array>

namespace seaglint {

// Smooth taper: 1 for x <= from_to[0], 0 for x >= from_to[1].
double smooth_taper(double x, const std::array<double, 2>& from_to);

// Linear interpolation between two ends, at a fraction of the interval from the first.
template <typename T>
T interpolate(const std::array<T, 2>& ends, double fraction) {
  return ends[0] + fraction * (ends[1] - ends[0]);
}

}  // namespace seaglint

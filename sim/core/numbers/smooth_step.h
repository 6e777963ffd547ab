// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Smooth and linear transitions between two values.

#include <array>

namespace seaglint {

// 1 up to the one value of x, 0 from the other on, smooth between.
double smooth_taper(double x, const std::array<double, 2>& from_to);

// What is linear between two ends, at a share of the way from the first.
template <typename T>
T interpolate(const std::array<T, 2>& ends, double share) {
  return ends[0] + share * (ends[1] - ends[0]);
}

}  // namespace seaglint

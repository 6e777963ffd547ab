// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Levels in maps: the peak, and the mean around a point.

#include <algorithm>
#include <cmath>
#include <vector>

#include "radar/rvmap/rv_map.h"

namespace seaglint {

struct Peak {
  double range_m = 0, velocity_mps = 0, level = 0;
  Complex value;
};

inline Peak peak_of(const RvMap& map) {
  Peak peak;
  for (std::size_t v = 0; v < map.velocity_mps.size(); ++v) {
    for (std::size_t r = 0; r < map.columns(); ++r)
      if (std::abs(map.at(v, r)) > peak.level)
        peak = {map.range_m[r], map.velocity_mps[v], std::abs(map.at(v, r)), map.at(v, r)};
  }
  return peak;
}

// Mean |RV|^2 of a map, m^2, in 5 velocities x 13 ranges around a point, without the cells outside the map.
inline double mean_around(const RvMap& map, double range_m, double velocity_mps) {
  const auto cell = [](const std::vector<double>& axis, double value) {
    return std::lround((value - axis.front()) / (axis[1] - axis[0]));
  };
  const long v = cell(map.velocity_mps, velocity_mps), r = cell(map.range_m, range_m);
  const long rows = static_cast<long>(map.velocity_mps.size()), columns = static_cast<long>(map.columns());
  double sum = 0, count = 0;
  for (long y = std::max(0L, v - 2); y <= std::min(rows - 1, v + 2); ++y) {
    for (long x = std::max(0L, r - 6); x <= std::min(columns - 1, r + 6); ++x) {
      sum += std::norm(map.at(static_cast<std::size_t>(y), static_cast<std::size_t>(x)));
      ++count;
    }
  }
  return sum / count;
}

}  // namespace seaglint

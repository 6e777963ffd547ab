// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/blanked_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seaglint {

namespace {

struct Band {
  double power = 0;
  std::size_t cells = 0;
};

int distance_band(double distance_m) {
  return static_cast<int>(std::upper_bound(std::begin(kBlankedDistancesM), std::end(kBlankedDistancesM), distance_m) -
                          std::begin(kBlankedDistancesM));
}

}  // namespace

std::vector<double> blanked_levels_db(const Sample& sample, const StoredAxes& axes) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const StoredCentre& centre : sample.centre_list) {
    nearest = std::min(nearest, static_cast<double>(centre[0]) - kBlankedMarginM);
    farthest = std::max(farthest, static_cast<double>(centre[0]) + kBlankedMarginM);
  }
  const std::size_t columns = axes.range_m.size(), rows = axes.velocity_mps.size();
  std::vector<Band> bands(kBlankedDistances * kBlankedVelocities);
  Band all;
  for (std::size_t r = 0; r < columns; ++r) {
    const double outside = std::max(nearest - axes.range_m[r], axes.range_m[r] - farthest);
    if (outside <= 0) continue;
    // Without a centre nothing is blanked and the distance is infinite.
    Band* const column = &bands[static_cast<std::size_t>(distance_band(outside)) * kBlankedVelocities];
    for (std::size_t v = 0; v < rows; ++v) {
      const double power = std::pow(static_cast<double>(sample.magnitude[v * columns + r]), 2);
      for (Band* band : {column + v * kBlankedVelocities / rows, &all}) {
        band->power += power;
        ++band->cells;
      }
    }
  }
  std::vector<double> levels_db(bands.size(), 0.0);
  if (!(all.power > 0)) return levels_db;
  const double mean = all.power / static_cast<double>(all.cells);
  constexpr double kLowest = 1e-10;  // -100 dB
  for (std::size_t i = 0; i < bands.size(); ++i) {
    if (bands[i].cells > 0)
      levels_db[i] = 10 * std::log10(std::max(bands[i].power / static_cast<double>(bands[i].cells) / mean, kLowest));
  }
  return levels_db;
}

}  // namespace seaglint

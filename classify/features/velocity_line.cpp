// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/velocity_line.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace seaglint {
namespace {

constexpr std::size_t kMostCentres = 64;  // 2,016 pairs
constexpr double kOneRange_m = 1e-6;      // ranges within a micrometre count as equal

struct Weighted {
  double value = 0, weight = 0;
};

// The smallest value up to which the weights reach half of their sum; 0 without values.
double weighted_median(std::vector<Weighted> all) {
  std::sort(all.begin(), all.end(), [](const Weighted& a, const Weighted& b) {
    return std::pair(a.value, a.weight) < std::pair(b.value, b.weight);
  });
  double total = 0, sum = 0;
  for (const Weighted& entry : all) total += entry.weight;
  for (const Weighted& entry : all) {
    sum += entry.weight;
    if (2 * sum >= total) return entry.value;
  }
  return 0;
}

}  // namespace

VelocityLine robust_velocity_line(std::span<const ScatteringCentre> centres) {
  const auto used = centres.first(std::min(centres.size(), kMostCentres));
  std::vector<Weighted> slopes, offsets;
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (std::size_t k = i + 1; k < used.size(); ++k) {
      const double apart_m = used[k].range_m - used[i].range_m;
      if (std::abs(apart_m) < kOneRange_m) continue;
      slopes.push_back({(used[k].velocity_mps - used[i].velocity_mps) / apart_m,
                        used[i].amplitude_m * used[k].amplitude_m * std::abs(apart_m)});
    }
  }
  VelocityLine line;
  line.slope = weighted_median(std::move(slopes));
  for (const ScatteringCentre& centre : used)
    offsets.push_back({centre.velocity_mps - line.slope * centre.range_m, centre.amplitude_m});
  line.offset = weighted_median(std::move(offsets));
  return line;
}

}  // namespace seaglint

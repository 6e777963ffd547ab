// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/bound.h"

#include <fmt/format.h>

namespace seaglint {

bool Bound::holds(double value) const {
  if (or_zero && value == 0) return true;
  const bool low = without_lowest ? value > lowest : value >= lowest;
  const bool high = without_highest ? value < highest : value <= highest;
  return low && high;
}

std::string Bound::text() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!without_lowest && !without_highest && lowest > -kInfinity && highest < kInfinity) {
    return fmt::format("within {} and {}", lowest, highest);
  }
  std::string low;
  std::string high;
  if (lowest > -kInfinity) low = fmt::format("{} {}", without_lowest ? "greater than" : "at least", lowest);
  if (highest < kInfinity) high = fmt::format("{} {}", without_highest ? "less than" : "at most", highest);
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

}  // namespace seaglint

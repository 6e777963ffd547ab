// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/real_functions.h"

#include <limits>

namespace seaglint {

double quantile(std::span<const double> ascending, double p) {
  if (ascending.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = p * static_cast<double>(ascending.size() - 1);
  const std::size_t below = static_cast<std::size_t>(place), above = std::min(below + 1, ascending.size() - 1);
  return ascending[below] + (place - static_cast<double>(below)) * (ascending[above] - ascending[below]);
}

Quartiles quartiles(std::vector<double> values) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  std::ranges::sort(values);
  return {quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)};
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace seaglint {

// count numbers from `from` on, a step apart.
inline std::vector<double> grid(double from, double step, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + step * i);
  return values;
}

}  // namespace seaglint

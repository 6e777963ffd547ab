// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How far two complex series are apart.

#include <cmath>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// |a - b| / |b| in the L2 norm, for series of equal length.
inline double relative_difference(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  double difference = 0, power = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += std::norm(a[i] - b[i]);
    power += std::norm(b[i]);
  }
  return std::sqrt(difference / power);
}

}  // namespace seaglint

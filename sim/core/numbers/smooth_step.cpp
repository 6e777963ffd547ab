// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/smooth_step.h"

#include <algorithm>

namespace seaglint {

double smooth_taper(double x, const std::array<double, 2>& from_to) {
  const double beyond = std::clamp((x - from_to[0]) / (from_to[1] - from_to[0]), 0.0, 1.0);
  return 1 - beyond * beyond * (3 - 2 * beyond);
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/plain_polygons.h"

#include <cmath>

namespace seaglint {

std::optional<float> coordinate_of(double value) {
  if (!(std::abs(value) <= 1e30)) return std::nullopt;
  return std::abs(value) < 1e-30 ? 0.0f : static_cast<float>(value) + 0.0f;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/polygons/coordinate.h"

#include <cmath>

namespace seaglint {

std::optional<double> coordinate_of(double value) {
  if (!(std::abs(value) <= 1e30)) return std::nullopt;
  return std::abs(value) < 1e-30 ? 0.0 : value;
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Range of the coordinates in polygon files.

#include <optional>

namespace seaglint {

// A coordinate as it is; nullopt when not finite or beyond 1e30; 0 below 1e-30, so that its square does not vanish in
// float32.
std::optional<double> coordinate_of(double value);

}  // namespace seaglint

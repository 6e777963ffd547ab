// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Dispersion relation of linear water waves.

#include <limits>

namespace seaglint {

inline constexpr double kDeepWater = std::numeric_limits<double>::infinity();  // as a depth, m

// Wavenumber by w^2 = g k tanh(k h) (Airy), rad/m, to rounding; omega >= 0, depth > 0.
double wavenumber_at(double omega, double depth = kDeepWater);

// Breaking limit: height of the steepest regular wave, L/7 tanh(k h), m (Michell 1893 in deep water, Miche 1944); omega
// > 0.
double breaking_height(double omega, double depth = kDeepWater);

}  // namespace seaglint

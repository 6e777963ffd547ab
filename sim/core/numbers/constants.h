// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Physical constants and unit conversions (CONVENTIONS.md, "Units"). SI and radians inside; other units only at the
// edges.

#include <limits>
#include <numbers>

namespace seaglint {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();  // of a quantity that is undefined
inline constexpr double kSpeedOfLight = 299792458.0;                      // m/s, exact
inline constexpr double kGravity = 9.81;                                  // m/s^2
inline constexpr double kSeaWaterDensity = 1025.0;                        // kg/m^3

constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/linear.h"

namespace seaglint {

inline constexpr double kMinArea_m2 = 1e-100;  // floor for an exact zero, -1000 dBsm

// Level of a radar cross-section in m^2, dBsm; at least that of min_m2.
inline double dbsm_of_area(double area_m2, double min_m2 = kMinArea_m2) {
  return 10 * std::log10(std::max(area_m2, min_m2));
}

// Level of a scattering amplitude s in metres, 4 pi |s|^2, dBsm; at least that of min_m2.
inline double dbsm(const Complex& s, double min_m2 = kMinArea_m2) {
  return dbsm_of_area(4 * kPi * std::norm(s), min_m2);
}

// Magnitude in metres of an amplitude of this level in dBsm.
inline double amplitude_of_dbsm(double level_dbsm) { return std::sqrt(std::pow(10.0, level_dbsm / 10) / (4 * kPi)); }

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One value of a cut of the radar cross section from elsewhere.

#include <optional>

#include "sim/core/numbers/linear.h"

namespace seaglint {

inline constexpr const char* kPolarisationNames[] = {"hh", "hv", "vh", "vv"};

struct ReferenceSample {
  double frequency_hz = 0;
  double theta_deg = 0;  // 0..180
  double phi_deg = 0;    // 0 <= x < 360, the file's own
  double level_dbsm = 0;
  std::optional<Complex> amplitude_m;  // about the file's phase origin; absent without a phase
};

inline constexpr double kMinLevel_dbsm = -1000;  // of an exact zero

// Maps a direction to theta 0..180, phi 0..360; true if theta was below 0 or above 180, on the other half of the great
// circle.
bool fold_direction(double& theta_deg, double& phi_deg);

}  // namespace seaglint

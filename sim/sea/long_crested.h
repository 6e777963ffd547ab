// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Waves of one direction in deep water, whose double sums of second order are running sums: O(N) and exact.

#include <cstddef>

#include "sim/sea/wave_component.h"

namespace seaglint {

// The surface along the waves' direction xi.
struct LongCrestedSurface {
  double elevation_linear = 0;  // m
  double elevation = 0;         // m
  double slope = 0;             // d/d xi
  double velocity = 0;          // m/s, along the waves
  double vertical_velocity = 0;
  double acceleration = 0;  // m/s^2, along the waves
  double vertical_acceleration = 0;
};

// cosine, sine: of each component's angle; the first `quadratic` components, ascending in omega, enter the quadratic
// sums. The second leaves velocity and acceleration at 0.
LongCrestedSurface long_crested_kinematics(const WaveComponent* component, const double* cosine, const double* sine,
                                           std::size_t count, std::size_t quadratic);
LongCrestedSurface long_crested_elevation(const WaveComponent* component, const double* cosine, const double* sine,
                                          std::size_t count, std::size_t quadratic);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Long-crested waves in deep water: the double sums of second order reduce to running sums, exact in O(N).

#include <cstddef>

#include "sim/sea/wave_component.h"

namespace seaglint {

// Surface along the propagation direction xi.
struct LongCrestedSurface {
  double elevation_linear = 0;  // m
  double elevation = 0;         // m
  double slope = 0;             // d/d xi
  double velocity = 0;          // m/s, along xi
  double vertical_velocity = 0;
  double acceleration = 0;  // m/s^2, along xi
  double vertical_acceleration = 0;
};

// cosine, sine: of the phase angle of each component; the first `quadratic` components, ascending in omega, enter the
// quadratic sums. The second function leaves velocity and acceleration at 0.
LongCrestedSurface long_crested_kinematics(const WaveComponent* component, const double* cosine, const double* sine,
                                           std::size_t count, std::size_t quadratic);
LongCrestedSurface long_crested_elevation(const WaveComponent* component, const double* cosine, const double* sine,
                                          std::size_t count, std::size_t quadratic);

}  // namespace seaglint

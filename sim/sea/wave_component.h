// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One plane wave of the sea.

#include "sim/core/numbers/dispersion.h"
#include "sim/core/numbers/linear.h"

namespace seaglint {

// a cos(w t - k d.x + phase), d the unit vector of its propagation direction.
struct WaveComponent {
  double omega = 0;       // rad/s
  double amplitude = 0;   // m
  double phase = 0;       // rad, at x = 0, t = 0
  double wavenumber = 0;  // rad/m, by the dispersion relation at the depth
  Vec2 direction{1, 0};   // of propagation, unit vector, in T
};

}  // namespace seaglint

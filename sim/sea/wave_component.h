// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One plane wave of the sea.

#include "sim/core/numbers/dispersion.h"
#include "sim/core/numbers/linear.h"

namespace seaglint {

// a cos(w t - k d.x + phase), d the unit vector it travels along.
struct WaveComponent {
  double omega = 0;       // rad/s
  double amplitude = 0;   // m
  double phase = 0;       // rad, at x = 0, t = 0
  double wavenumber = 0;  // rad/m, of the depth's dispersion relation
  Vec2 direction{1, 0};   // of travel, of length 1, in T
};

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/scenario/sea_spec.h"

namespace seaglint {

// A long-crested JONSWAP sea in deep water with the default cut-offs; height in m, period in s.
inline SeaState state_of(double height, double period) {
  SeaState state;
  state.significant_wave_height_m = height;
  state.peak_period_s = period;
  state.cutoff_rad_s = 0;
  state.second_order_cutoff_rad_s = 0;
  return state;
}

}  // namespace seaglint

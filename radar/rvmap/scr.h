// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Signal-to-clutter ratio in three definitions (radar/rvmap/README.md): scaled to one, measured in all.

#include "radar/echo/echo.h"
#include "radar/rvmap/rv_map.h"

namespace seaglint {

// Target extent: the smallest rectangle of map cells that contains every cell within 10 dB of the peak; indices, both
// ends included.
struct MapExtent {
  std::size_t range_first = 0, range_last = 0, velocity_first = 0, velocity_last = 0;
};
MapExtent target_extent(const RvMap& target);

// Received signal of an interval with the clutter at the level of the scenario.
struct ReceivedInterval {
  std::vector<Complex> echo;  // target + clutter + noise, [pulse][frequency]
  RvMap map;                  // map of that echo
  MeasuredRatios scr;
};

// Sum of target, clutter and noise with its map, and the measured target-to-clutter ratio in three definitions and
// target-to-noise ratio per pulse. clutter.level scr: the clutter, with noise that is relative to it, is first scaled
// so that the ratio of clutter.scr_definition is scr_db exactly in this map:
//   frequencies_per_pulse  mean |Y_target|^2 over mean |Y_clutter|^2, all pulses and in-band frequencies
//   peak_cell maximum |RV|^2 of the target over the mean |RV|^2 of the clutter's map
//   extent     mean |RV|^2 of the target inside target_extent over the mean |RV|^2 of the clutter's map
// Throws InputError when clutter is present and the target or the clutter is zero in the map.
ReceivedInterval form_received_interval(const Echo& echo, const PulseTrain& train, const ClutterSpec& clutter,
                                        const MapSpec& spec, bool intra_pulse_motion);

}  // namespace seaglint

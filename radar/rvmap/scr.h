// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Signal-to-clutter ratio in its three meanings (radar/rvmap/README.md): scaled to one, measured in all.

#include "radar/echo/echo.h"
#include "radar/rvmap/rv_map.h"

namespace seaglint {

// The target's own box in its map: the smallest rectangle that holds every cell within 10 dB of the peak; indices, both
// ends included.
struct MapExtent {
  std::size_t range_first = 0, range_last = 0, velocity_first = 0, velocity_last = 0;
};
MapExtent target_extent(const RvMap& target);

// What the radar receives in an interval, once the clutter has the scenario's level.
struct ReceivedInterval {
  std::vector<Complex> echo;  // target + clutter + noise, [pulse][frequency]
  RvMap map;                  // of that echo
  MeasuredRatios scr;
};

// Adds everything up and measures the ratio of target and clutter in its three meanings, and of target and noise per
// pulse. Where clutter.level is scr, the clutter is first scaled so that the ratio named by clutter.scr_definition is
// scr_db exactly in this map, with the noise where that is relative to it:
//   frequencies_per_pulse  mean |Y_target|^2 over mean |Y_clutter|^2, all pulses and in-band frequencies
//   peak_cell  largest |RV|^2 of the target over the mean |RV|^2 of the clutter's map
//   extent     mean |RV|^2 of the target inside target_extent over the mean |RV|^2 of the clutter's map
// With clutter, throws InputError when the map holds nothing of the target, or nothing of the clutter.
ReceivedInterval form_received_interval(const Echo& echo, const PulseTrain& train, const ClutterSpec& clutter,
                                        const MapSpec& spec, bool intra_pulse_motion);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scattering centres of a range-velocity map by CLEAN.

#include <span>
#include <vector>

#include "classify/features/residual_echo.h"
#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/scenario/learning_spec.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

struct ScatteringCentre {
  double range_m = 0;
  double velocity_mps = 0;
  double amplitude_m = 0;
};

// Scattering centres of an interval's echo (target, clutter and noise, [pulse][frequency]), strongest first, by CLEAN
// with the exact point response of the map's code, holes and tapers (classify/features/README.md). A centre is inside
// the map or less than a cell outside, within dynamic_range_db of the strongest, more than a main lobe's width from
// every stronger one, and above the floor and the clutter around it (local_level.h) by a threshold that noise or
// textured clutter exceeds in 1 % of maps.
struct CleanedMap {
  std::vector<ScatteringCentre> centres;   // strongest first
  std::vector<CleanComponent> components;  // subtracted from the echo, in that order
  RvMap residual;                          // exact map of the residual echo
};
CleanedMap clean_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& map_spec,
                     bool intra_pulse_motion, const FeatureSpec& spec);

}  // namespace seaglint

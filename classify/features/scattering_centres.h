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
// with the point response of the map's actual code, holes and tapers included (classify/features/README.md). A centre
// lies inside the map or less than a cell beside it, within dynamic_range_db of the strongest, above the floor of the
// final residual and the mean of its surroundings in it by what noise and textured clutter pass in one map out of a
// hundred, and more than a lobe's width away from every stronger one.
struct CleanedMap {
  std::vector<ScatteringCentre> centres;   // strongest first
  std::vector<CleanComponent> components;  // what was taken out of the echo, in that order
  RvMap residual;                          // exact map of what is left
};
CleanedMap clean_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& map_spec,
                     bool intra_pulse_motion, const FeatureSpec& spec);

// Its centres alone.
std::vector<ScatteringCentre> extract_centres(std::span<const Complex> echo, const PulseTrain& train,
                                              const MapSpec& map_spec, bool intra_pulse_motion,
                                              const FeatureSpec& spec);

}  // namespace seaglint

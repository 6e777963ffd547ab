// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scattering centres of a range-velocity map by CLEAN, and CLEAN's restored map.

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
// every stronger one, and above the floor and the clutter around it (exceeds_local_level()) by a threshold that noise
// or textured clutter exceeds in 1 % of maps. Throws Interrupted when *stop becomes true.
struct CleanedMap {
  std::vector<ScatteringCentre> centres;   // strongest first
  std::vector<CleanComponent> components;  // subtracted from the echo, in that order
  RvMap residual;                          // exact map of the residual echo
};
CleanedMap clean_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& map_spec,
                     bool intra_pulse_motion, const FeatureSpec& spec, const StopFlag* stop = nullptr);

// Residual plus all components with a clean point response (Hogbom 1974, section 2). The components return with the
// point response of a radar that transmits the whole band with every pulse: main and side lobes of the tapers, without
// the hop code's pedestal and without holes.
RvMap restored_map(const CleanedMap& cleaned, const PulseTrain& train, const MapSpec& map_spec);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hand-made features of a range-velocity map (paper, section III-B): scattering centres, MWR, CCF and the spreads.

#include <span>
#include <vector>

#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

struct ScatteringCentre {
  double range_m = 0;
  double velocity_mps = 0;
  double amplitude_m = 0;
};

struct FeatureVector {
  double mwr = 0;         // (m/s)^2
  double ccf = 0;         // 0..1
  double sigma_r = 0;     // m
  double sigma_v = 0;     // m/s
  int centres = 0;
  bool degenerate = false;  // fewer than 3 centres: features are defined and finite, but say little
};

// CLEAN with the point response of the map's actual code, holes and taper included; strongest first.
std::vector<ScatteringCentre> extract_centres(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& map_spec,
                                              bool intra_pulse_motion, const FeatureSpec& spec);

FeatureVector compute_features(std::span<const ScatteringCentre> centres, const FeatureSpec& spec);

}  // namespace seaglint

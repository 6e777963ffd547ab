// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hand-made features of a range-velocity map (paper, section III-B): scattering centres, MWR, CCF and the spreads.

#include <span>
#include <vector>

#include "classify/features/residual_echo.h"
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
  double mwr = 0;      // (m/s)^2
  double ccf = 0;      // 0..1
  double sigma_r = 0;  // m
  double sigma_v = 0;  // m/s
  int centres = 0;
  bool degenerate = false;  // fewer than 3 centres: features are defined and finite, but say little
};

// Scattering centres of an interval's echo (target, clutter and noise, [pulse][frequency]), strongest first, by CLEAN
// with the point response of the map's actual code, holes and tapers included (classify/features/README.md). A centre
// lies inside the map or less than a cell beside it, within dynamic_range_db of the strongest, above the floor of the
// final residual and the mean of its surroundings in it by what noise and textured clutter pass in one map out of a
// hundred, and more than a lobe's width away from every stronger one.
struct CleanedMap {
  std::vector<ScatteringCentre> centres;  // strongest first
  std::vector<PointComponent> removed;    // what was taken out of the echo, in that order
  RvMap residual;                         // exact map of what is left
};
CleanedMap clean_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& map_spec,
                     bool intra_pulse_motion, const FeatureSpec& spec);

// The map as a radar would see it that sends the whole band with every pulse: what was removed comes back with the
// lobes of the tapers alone, without the hop code's pedestal and without holes.
RvMap restored_map(const CleanedMap& cleaned, const PulseTrain& train, const MapSpec& map_spec);

// README.md. With N_sc centres, weights w_i = N_sc A_i / sum A, and the least-squares line v^ = a r + b
// (unweighted unless spec.weighted_fit; a = 0 for centres at one range):
//   MWR = (1/N_sc) sum w_i (v_i - v^_i)^2      sigma_r, sigma_v standard deviations (divisor N_sc)
//   CCF = |(s_r - s_v) / (s_r + s_v + 1e-6)|   s_r = sigma_r / range_scale_m, s_v = sigma_v / velocity_scale_mps
// Without centres all are 0.
FeatureVector compute_features(std::span<const ScatteringCentre> centres, const FeatureSpec& spec);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hand-made features of a map's scattering centres (paper, section III-B): MWR, CCF and the spreads.

#include <span>

#include "classify/features/scattering_centres.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

struct FeatureVector {
  double mwr = 0;      // (m/s)^2
  double ccf = 0;      // 0..1
  double sigma_r = 0;  // m
  double sigma_v = 0;  // m/s
  int centres = 0;
  bool degenerate = false;  // fewer than 3 centres: features are defined and finite, but carry little information
};

// README.md. With N_sc centres, weights w_i = N_sc A_i / sum A, and the least-squares line v^ = a r + b
// (unweighted unless spec.weighted_fit; a = 0 for centres at one range):
//   MWR = (1/N_sc) sum w_i (v_i - v^_i)^2      sigma_r, sigma_v standard deviations (divisor N_sc)
//   CCF = |(s_r - s_v) / (s_r + s_v + 1e-6)|   s_r = sigma_r / range_scale_m, s_v = sigma_v / velocity_scale_mps
// Without centres all are 0.
FeatureVector compute_features(std::span<const ScatteringCentre> centres, const FeatureSpec& spec);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Features of rigidity beyond the paper's four: what is left of the centres' velocities when the rotation of a rigid
// body is taken out by the robust line (velocity_line.h). Deviations count by magnitude, so that one centre on a
// clutter peak, which dominates the squares of MWR, does not hide a line.

#include <array>
#include <span>

#include "classify/features/scattering_centres.h"

namespace seaglint {

// Weights are w_i = A_i / sum A, residuals e_i those of the robust line. Without centres all are 0.
struct MotionFeatures {
  // |slope| of the line, 1/s: rotation of the whole, small for bodies that move independently about one mean.
  double rotation_per_s = 0;
  // sum w_i |e_i|, m/s: velocities that no rotation explains; 0 for an elongated rigid body, up to the centres' errors.
  double residual_mps = 0;
  // 1 - sum w_i |e_i| / sum w_i |v_i - weighted median v|, at least 0: the part of the spread that rotation explains,
  // whatever the wave height; 0 without spread.
  double explained = 0;
  // Sum of the weights with |e_i| <= 0.01 m/s: the part of the amplitude that moves as one body within the error of a
  // centre.
  double on_line = 0;
};
MotionFeatures motion_features(std::span<const ScatteringCentre> centres);

inline constexpr std::array kMotionFeatureNames = {"rotation_per_s", "line_residual_mps", "line_explained",
                                                   "line_fraction"};

}  // namespace seaglint

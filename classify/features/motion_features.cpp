// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/motion_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "classify/features/velocity_line.h"

namespace seaglint {
namespace {

constexpr double kOnLine_mps = 0.01;

}  // namespace

MotionFeatures motion_features(std::span<const ScatteringCentre> centres) {
  MotionFeatures features;
  double sum = 0;
  for (const ScatteringCentre& centre : centres) sum += centre.amplitude_m;
  if (!(sum > 0)) return features;

  // The median velocity is the line of centres that are all at one range.
  std::vector<ScatteringCentre> at_one_range(centres.begin(), centres.end());
  for (ScatteringCentre& centre : at_one_range) centre.range_m = 0;
  const VelocityLine line = robust_velocity_line(centres), level = robust_velocity_line(at_one_range);
  double spread = 0;
  for (const ScatteringCentre& centre : centres) {
    const double weight = centre.amplitude_m / sum, residual = std::abs(line.residual(centre));
    features.residual_mps += weight * residual;
    spread += weight * std::abs(centre.velocity_mps - level.offset);
    if (residual <= kOnLine_mps) features.on_line += weight;
  }
  features.rotation_per_s = std::abs(line.slope);
  if (spread > 0) features.explained = std::max(0.0, 1 - features.residual_mps / spread);
  return features;
}

}  // namespace seaglint

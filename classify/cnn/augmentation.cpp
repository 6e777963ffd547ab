// SPDX-License-Identifier: BSD-3-Clause
#include "classify/cnn/augmentation.h"

#include <cmath>

namespace seaglint {

CentreList observed_otherwise(std::span<const ScatteringCentre> centres, Random& random) {
  const double side = random.below(2) == 0 ? 1 : -1;
  const double range_factor = side * (0.8 + 0.45 * random.uniform());
  const double velocity_factor = random.below(2) == 0 ? 1 : -1;
  const double rotation_rad_s = 0.00125 * random.normal();
  CentreList changed(centres.begin(), centres.end());
  double mean_m = 0;
  for (ScatteringCentre& centre : changed) {
    centre.range_m *= range_factor;
    mean_m += centre.range_m / static_cast<double>(changed.size());
  }
  for (ScatteringCentre& centre : changed)
    centre.velocity_mps = velocity_factor * centre.velocity_mps + rotation_rad_s * (centre.range_m - mean_m);
  return changed;
}

CentreList with_errors(CentreList centres, Random& random) {
  for (ScatteringCentre& centre : centres) {
    centre.range_m += 0.02 * random.normal();
    centre.velocity_mps += 0.001 * random.normal();
    centre.amplitude_m *= std::pow(10, 0.05 * random.normal());
  }
  return centres;
}

ImageOffset random_offset(Random& random) {
  ImageOffset offset;
  offset.columns = 4 * random.uniform() - 2;
  offset.rows = random.uniform() - 0.5;
  return offset;
}

}  // namespace seaglint

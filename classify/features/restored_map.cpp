// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/restored_map.h"

#include <cmath>
#include <vector>

#include "radar/rvmap/map_weights.h"
#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// sum of w_i e^{j a (x_i - x_0)} over i, for weights that add up to 1.
Complex lobe(const std::vector<double>& weight, const std::vector<double>& x, double a, double x_0) {
  Complex sum;
  for (std::size_t i = 0; i < x.size(); ++i) sum += weight[i] * std::polar(1.0, a * (x[i] - x_0));
  return sum;
}

std::vector<double> normalised(std::vector<double> weight) {
  double total = 0;
  for (const double w : weight) total += w;
  for (double& w : weight) w /= total;
  return weight;
}

}  // namespace

RvMap restored_map(const CleanedMap& cleaned, const PulseTrain& train, const MapSpec& map_spec) {
  const auto bins = static_cast<std::size_t>(train.band_bins());
  std::vector<double> frequency_hz(bins);
  for (std::size_t k = 0; k < bins; ++k)
    frequency_hz[k] =
        train.first_carrier_hz + train.baseband_hz.front() + static_cast<double>(k) * train.baseband_step_hz;
  const std::vector<double> range_weight = normalised(taper_samples(map_spec.range_taper, bins));
  const std::vector<double> velocity_weight = normalised(taper_samples(map_spec.velocity_taper, train.pulses()));

  RvMap map = cleaned.residual;
  const double centre_hz = train.band_centre_hz(), per_hz = 4 * kPi / kSpeedOfLight;
  for (const CleanComponent& point : cleaned.components) {
    std::vector<Complex> along_range, along_velocity;
    for (const double r : map.range_m)
      along_range.push_back(lobe(range_weight, frequency_hz, per_hz * (r - point.range_m), centre_hz));
    for (const double v : map.velocity_mps)
      along_velocity.push_back(lobe(velocity_weight, train.time_s, per_hz * centre_hz * (v - point.velocity_mps), 0));
    for (std::size_t v = 0; v < along_velocity.size(); ++v) {
      for (std::size_t r = 0; r < along_range.size(); ++r)
        map.values[v * map.columns() + r] += point.amplitude_m * along_velocity[v] * along_range[r];
    }
  }
  return map;
}

}  // namespace seaglint

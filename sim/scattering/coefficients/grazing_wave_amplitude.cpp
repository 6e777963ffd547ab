// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/grazing_wave_amplitude.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/coefficients/transition.h"

namespace seaglint {

Complex GrazingWaveAmplitude::at(double k, double fraction, double run) const {
  constexpr double kMinLength = 1e-12;  // m: at a vertex, where both edges meet, the product with the decay is finite
  constexpr double kFar = 1e15;         // parallel edges
  const double length = std::max(interpolate(l, fraction), kMinLength);
  const double phase = std::clamp(run * length / (l[1] - l[0]), -kFar, kFar);
  Complex boundaries =
      triple_transition_function(2 * k * launch_parameter * length, 2 * k * exit_parameter * length, -phase);
  for (int wave = 0; wave + 1 < grazing_waves; ++wave) boundaries *= transition_function(k * detour_m[wave]);
  return boundaries * std::pow(k, -0.5 * grazing_waves) / std::sqrt(length);
}

}  // namespace seaglint

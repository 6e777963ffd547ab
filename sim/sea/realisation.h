// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Random realisation of a sea state: its wave components, with the directions that the spreading of the energy
// prescribes.

#include <cstdint>

#include "sim/scenario/sea_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// Exponent s of cos^2s, by omega over the peak frequency: that of the spec, or Mitsuyasu's s (f/fp)^5 below the peak
// and s (f/fp)^-2.5 above (Mitsuyasu et al. 1975, in Goda's form).
double spreading_exponent(const SpreadingSpec& spec, double omega_over_peak);

// Quantile of the directional distribution: the angle from the mean direction below which, from -pi on, the fraction
// `probability` in (0, 1) of the energy lies; error 1e-10 rad, bit-identical on all machines. For the wrapped normal,
// the quantile of the normal distribution before wrapping.
double spreading_quantile(const SpreadingSpec& spec, double probability, double omega_over_peak);

// Components of wind sea and swell, in strata uniform in omega from the lowest frequency with energy to the cut-off.
// Each component has a random frequency within its stratum (so that the series is not periodic), the energy of the
// stratum, a random phase and, in a spread sea, a direction of its own; all amplitudes are then scaled so that sum
// a^2/2 is the energy of the spectrum. `amplitude: random`: a^2 is exponentially distributed with that mean, so that Hs
// varies between realisations as in records.
// Streams kWaveFrequency, kWavePhase, kWaveDirection, kWaveAmplitude of (seed, index). Hs = 0: flat water. Throws
// InputError for impossible states: a cut-off at or below the peak, waves above the breaking limit (breaking_height),
// zero depth.
WaveField realise_sea(const SeaState& state, std::uint64_t seed, std::uint64_t index);

// Width of the frequency strata of wind sea and swell, relative to the peak frequency of the system; 0 without waves.
// The standard deviation of the mean period T1 between realisations is 0.1 % at 0.02, 0.9 % at kMaxStratumWidth, 9 % at
// 0.5, 24 % at 1 (JONSWAP, gamma 3.3; 0.7 and 1.5 % at 0.1 with gamma 1 and 20), the largest component has a quarter of
// the energy at 0.1, seven tenths at 0.5.
struct StratumWidths {
  double wind_sea = 0;
  double swell = 0;
};
StratumWidths stratum_widths(const SeaState& state);
inline constexpr double kMaxStratumWidth = 0.1;

}  // namespace seaglint

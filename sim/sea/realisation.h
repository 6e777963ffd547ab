// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One realisation of a sea state: its wave components drawn at random.

#include <cstdint>

#include "sim/scenario/sea_spec.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

// A realisation: the components of the wind sea, and of the swell, in strata uniform in omega from the lowest frequency
// with energy to the cut-off, each at a random place of its stratum (so that nothing repeats) with the energy of its
// stratum, a random phase and, in a spread sea, a direction of its own, then scaled so that sum a^2/2 is the spectrum's
// energy. `amplitude: random` gives a^2 an exponential distribution with that mean, so that Hs varies between
// realisations as it does in records. Streams kWaveFrequency, kWavePhase, kWaveDirection, kWaveAmplitude of (seed,
// index). Hs = 0 gives flat water. Throws InputError for a state that no sea can have: a cut-off at or below the peak,
// waves steeper than breaking (breaking_height), no depth.
WaveField realise_sea(const SeaState& state, std::uint64_t seed, std::uint64_t index);

// Width of the strata from which the components of a state's systems are drawn, over the peak frequency of the system;
// 0 without waves. From one realisation to the next the mean period T1 scatters by 0.1 % (standard deviation) at 0.02,
// 0.9 % at kMaxStratumWidth, 9 % at 0.5, 24 % at 1 (JONSWAP, gamma 3.3; 0.7 and 1.5 % at 0.1 with gamma 1 and 20), and
// the largest component holds a quarter of the energy at 0.1, seven tenths at 0.5.
struct StratumWidths {
  double wind_sea = 0;
  double swell = 0;
};
StratumWidths stratum_widths(const SeaState& state);
inline constexpr double kMaxStratumWidth = 0.1;

}  // namespace seaglint

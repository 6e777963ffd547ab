// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What else can be made of the interval behind a map.

#include "tools/pipeline/pipeline.h"

namespace seaglint {

// Target's echo and map as a radar would have them that sends the whole synthesised band with every pulse, without
// clutter and noise: an ISAR image, range against the velocity across it. Same carriers' band, times and motion, the
// radar's own included.
struct FullBandInterval {
  PulseTrain train;           // of one carrier, in the middle of the band
  std::vector<Complex> echo;  // [pulse][frequency]
  RvMap image;
};
FullBandInterval full_band_interval(const Pipeline& pipeline, std::size_t sample);

// High-resolution range profiles |HRRP| of single pulses of it, metres, [pulse][range].
struct RangeProfiles {
  std::vector<double> time_s, range_m;
  std::vector<double> magnitude_m;
};
RangeProfiles range_profiles(const FullBandInterval& band, const MapSpec& spec);

}  // namespace seaglint

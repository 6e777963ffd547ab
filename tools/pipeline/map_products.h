// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// ISAR image and range profiles of the interval of a map.

#include "tools/pipeline/pipeline.h"

namespace seaglint {

// Echo and map of the target alone, without clutter and noise, for a radar that transmits the whole synthetic bandwidth
// with every pulse: an ISAR image (range, velocity). Band, pulse times and motion, including the radar's own, are those
// of the map.
struct FullBandInterval {
  PulseTrain train;           // of one carrier, in the middle of the band
  std::vector<Complex> echo;  // [pulse][frequency]
  RvMap image;
};
FullBandInterval full_band_interval(const Pipeline& pipeline, std::size_t sample);

// High-resolution range profiles |HRRP| of its single pulses, metres, [pulse][range].
struct RangeProfiles {
  std::vector<double> time_s, range_m;
  std::vector<double> magnitude_m;
};
RangeProfiles range_profiles(const FullBandInterval& band, const MapSpec& spec);

}  // namespace seaglint

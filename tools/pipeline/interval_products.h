// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Other products of the interval of a map: ISAR image, range profiles, I/Q samples.

#include "radar/echo/echo.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

// ISAR image and range profiles of the interval of a map.

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

// Echo of a sample over time as I/Q samples of a receiver.

// Target and clutter are those of the sample's map, at the same levels. Noise has the level of the map's noise but is
// another realisation: the map's frequencies contain only one part in `refinement` of it.
struct SampledInterval {
  PulseTrain train;                           // of the map
  SampledEcho target;                         // of the target with its companions
  std::optional<SampledEcho> clutter, noise;  // absent where the scenario has none
  SampleRecord record;                        // row of the sample in a data set
};

// Throws InputError when radar.sampling_mhz fits no frequency grid, or the echo would hold more than 2^27 samples.
SampledInterval sampled_interval(const Pipeline& pipeline, std::size_t sample);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Echo of a sample over time as I/Q samples of a receiver.

#include "radar/echo/sampled_echo.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

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

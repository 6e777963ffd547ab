// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A sample's echo over time, as an I/Q receiver records it.

#include "radar/echo/sampled_echo.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

// Target and clutter are those of the sample's map, at the levels they have there; noise has the level of the map's but
// is another realisation, as a map's frequencies hold one part in `refinement` of it.
struct SampledInterval {
  PulseTrain train;                           // of the map
  SampledEcho target;                         // of the target with its companions
  std::optional<SampledEcho> clutter, noise;  // nothing where the scenario has none
};

// Throws InputError when radar.sampling_mhz fits no frequency grid, or the echo would hold more than 2^27 samples.
SampledInterval sampled_interval(const Pipeline& pipeline, std::size_t sample);

}  // namespace seaglint

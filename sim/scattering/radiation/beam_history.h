// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reflections on the path of a beam, as far as they determine how uncertain its contribution is.

#include "sim/scattering/tracing/beam_segment.h"

namespace seaglint {

class Scatterer;

struct BeamHistory {
  // Displacement of the beam on its last panel over that of the vertices of its reflectors, the root of a sum of
  // squares: a reflector of width b is tilted by 1 / b, and a beam of length l behind it is displaced by 2 l / b. 0 at
  // the first reflection.
  float displacement = 0;
  // Mean distance between consecutive reflections, m, where the panel and all reflectors belong to one part; else 0.
  float wall_distance = 0;
};

// Of the reflections before the candidate. The width of a reflector is the area of its panel over its largest extent.
BeamHistory beam_history(const BeamSegment& segment, const CandidatePanel& candidate, const Scatterer& scatterer);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What curved facets do to a beam: to its rays when they are mirrors, to its echo when they are lit (README.md, "Curved
// surfaces").

#include <memory>
#include <span>

#include "sim/scattering/beam_leg.h"
#include "sim/scattering/curvature.h"
#include "sim/scattering/panels.h"
#include "sim/scattering/smooth_surface.h"

namespace seaglint {

// What all beams of an illumination share.
struct Curving {
  std::span<const Facet> facets;
  const SmoothSurface& surface;
  const AntennaPair& antennas;
};

// The rays as they leave the candidate; those of flat mirrors where neither it nor one before it is curved.
BentRays reflected_rays(const Curving& on, const Leg& leg, const Candidate& candidate);

// What the curvature of a facet and of the mirrors before it adds to a footprint whose flat phase and pattern are set;
// null where all are flat. Its triangle is the curved facet, or holds the whole flat panel.
std::shared_ptr<const Curvature> curvature_of(const Curving& on, const Panels& panels, const Leg& leg,
                                              const Candidate& candidate, const Footprint& footprint);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Follows beams from mirror to mirror and writes down what they light. Illumination is the way in.

#include <functional>
#include <span>
#include <vector>

#include "sim/scattering/illuminate.h"

namespace seaglint {

// What all beams of an illumination share.
struct BeamScene {
  const Scatterer& scatterer;
  const AntennaPair& antennas;
  const IlluminationSettings& settings;
  const VisibleSurface& lit;                       // from the transmitter
  const VisibleSurface& visible;                   // to the receiver
  std::span<const std::vector<Surface>> surfaces;  // [material][wavenumber]; none for a perfect conductor
  double min_area = 0;                             // of lit pieces that count, m^2
  double min_beam_area = 0;                        // of beams that are followed to further mirrors, m^2
};

// Appends what all beams light whose first mirror is the panel of one of these facets; returns the legs followed. Calls
// after_each() when the beams of one are followed.
std::size_t trace_beams(
    const BeamScene& scene, std::span<const int> facets, Lit& out, const std::function<void()>& after_each = [] {});

}  // namespace seaglint

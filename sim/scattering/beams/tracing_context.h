// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "sim/scattering/response/illumination.h"

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

  // What the facet is made of at each wavenumber; none when it is a perfect conductor.
  std::span<const Surface> surface_of(int facet) const {
    if (surfaces.empty()) return {};
    return surfaces[scatterer.facets()[facet].material];
  }
  bool is_under_water(int facet) const {
    const std::span<const Surface> surface = surface_of(facet);
    return !surface.empty() && surface.front().is_under_water();
  }
};

}  // namespace seaglint

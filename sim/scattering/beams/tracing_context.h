// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/beams/illumination_settings.h"
#include "sim/scattering/beams/visible_surface.h"
#include "sim/scattering/material/material.h"
#include "sim/scattering/target/scatterer.h"

namespace seaglint {

// An antenna that receives what the beams light. Pair and surface are those of one transmitter and this receiver.
struct Receiver {
  BistaticGeometry geometry;
  const VisibleSurface* visible_to_receiver;  // to the receiver
};

// What all beams of an illumination share.
struct TracingContext {
  const Scatterer& scatterer;
  const RadarBasis& transmit;
  std::span<const Receiver> receivers;  // none: what the beams light is followed alone
  const TracingSettings& settings;
  const VisibleSurface& visible_to_transmitter;            // from the transmitter
  std::span<const std::vector<MaterialSurface>> surfaces;  // [material][wavenumber]; none for a perfect conductor
  double min_area = 0;                                     // of lit pieces that count, m^2
  double min_beam_area = 0;                                // of beams that are followed to further mirrors, m^2

  // What the facet is made of at each wavenumber; none when it is a perfect conductor.
  std::span<const MaterialSurface> surface_of(int facet) const {
    if (surfaces.empty()) return {};
    return surfaces[scatterer.facets()[facet].material];
  }
  bool is_submerged(int facet) const {
    const std::span<const MaterialSurface> surface = surface_of(facet);
    return !surface.empty() && surface.front().is_submerged();
  }
};

}  // namespace seaglint

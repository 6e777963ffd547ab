// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Input of the beam tracer: target, look directions, settings and visible surfaces.

#include <span>
#include <vector>

#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/observation/bistatic_geometry.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/illumination_settings.h"
#include "sim/scattering/tracing/visible_surface.h"

namespace seaglint {

// Receiver of one illumination. geometry: the transmitter and this receiver.
struct Receiver {
  BistaticGeometry geometry;
  const VisibleSurface* visible_to_receiver;  // visible part of the surface as seen from it; null: not known
};

// What the beams of one illumination have in common.
struct TracingContext {
  const Scatterer& scatterer;
  const RadarBasis& transmit;
  std::span<const Receiver> receivers;  // none: beams are traced for their illumination only
  const TracingSettings& settings;
  const VisibleSurface* visible_to_transmitter;            // directly illuminated part of the surface; null: not known
  std::span<const std::vector<MaterialSurface>> surfaces;  // [material][wavenumber]; none for a perfect conductor
  SmallestAreas min_area;                                  // of illuminated patches that are kept, m^2
  double min_beam_per_patch = 1;  // area of the smallest beam cross-section that is reflected further over min_area

  // Material of the facet at each wavenumber; empty for a perfect conductor.
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

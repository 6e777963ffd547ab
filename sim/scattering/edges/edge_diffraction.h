// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Everything that sharp edges answer: single diffraction by all ways, and edge waves that meet a second edge.

#include <functional>
#include <span>
#include <vector>

#include "sim/scattering/beams/illumination_settings.h"
#include "sim/scattering/edges/edge_contribution.h"
#include "sim/scattering/edges/edge_illumination.h"
#include "sim/scattering/edges/multiple_diffraction.h"

namespace seaglint {

// Which edge waves are followed: those of straight runs of edges of three ray spacings and more, 0.2 m on the 144 m
// ship by default, to a third and fourth diffraction where a run is twenty long, 1.4 m; none fainter than
// min_amplitude() at the lowest wavenumber.
MultipleDiffractionLimits multiple_diffraction_limits(const Scatterer& scatterer, const TracingSettings& settings,
                                                      double lowest);

// Calls visit(chunk, footprints), chunk = 0..kEdgeChunks-1, for what each edge answers, those of a chunk in order from
// one thread. `incoming`: what the transmitter's illumination at the same wavenumbers reached; `outgoing`: what the
// waves reach that the receiver would send, the same object for one antenna. Echoes that the settings' filter leaves
// out are not among them. Chunks do not depend on `threads`; without edges in the settings there are none.
inline constexpr std::size_t kEdgeChunks = 16;
void edge_diffraction(const Scatterer& scatterer, const BistaticGeometry& geometry, const TracingSettings& settings,
                      std::span<const double> wavenumbers, const IlluminationByEdge& incoming,
                      const IlluminationByEdge& outgoing, int threads,
                      const std::function<void(std::size_t, std::span<const EdgeContribution>)>& visit);

}  // namespace seaglint

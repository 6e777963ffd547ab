// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// All contributions of sharp edges: single diffraction over all path combinations, and multiple diffraction.

#include <functional>
#include <span>
#include <vector>

#include "sim/scattering/radiation/edge_contribution.h"
#include "sim/scattering/radiation/multiple_diffraction.h"
#include "sim/scattering/tracing/edge_illumination.h"
#include "sim/scattering/tracing/illumination_settings.h"

namespace seaglint {

// Limits of multiple diffraction: straight runs of edges of at least 42 times the smallest patch side (0.2 m on the 144
// m ship by default); third and fourth order for runs of at least 280 times that side (1.4 m); contributions of at
// least min_amplitude() at the lowest wavenumber.
MultipleDiffractionLimits multiple_diffraction_limits(const Scatterer& scatterer, const TracingSettings& settings,
                                                      double lowest);

// Calls visit(chunk, contributions), chunk = 0..kEdgeChunks-1, with the contributions of each edge; those of a chunk
// arrive in order from one thread. `incoming`: edge illumination by the transmitter at the same wavenumbers;
// `outgoing`: edge illumination by a wave from the receiver, the same object for one antenna. Contributions rejected by
// the filter of the settings are omitted. Chunks do not depend on `threads`; there are none when edge diffraction is
// off.
inline constexpr std::size_t kEdgeChunks = 16;
void edge_diffraction(const Scatterer& scatterer, const BistaticGeometry& geometry, const TracingSettings& settings,
                      std::span<const double> wavenumbers, const IlluminationByEdge& incoming,
                      const IlluminationByEdge& outgoing, int threads,
                      const std::function<void(std::size_t, std::span<const EdgeContribution>)>& visit);

}  // namespace seaglint

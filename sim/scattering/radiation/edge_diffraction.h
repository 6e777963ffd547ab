// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Contributions of sharp edges: single diffraction over all combinations of paths, and multiple diffraction.
//
// An interval of an edge is illuminated directly or after reflections; exit paths are found by tracing the receiver's
// wave back to the edge (reciprocity). Each pair of an incident and an exit path with a common interval is one
// contribution. For one antenna two reciprocal paths are one contribution.

#include <cstddef>
#include <functional>
#include <span>

#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/radiation/multiple_diffraction.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/edge_illumination.h"
#include "sim/scattering/tracing/illumination_settings.h"

namespace seaglint {

// Limits of multiple diffraction: straight runs of edges of at least 42 times the smallest patch side (0.2 m on the 144
// m ship by default); third and fourth order for runs of at least 280 times that side (1.4 m); contributions of at
// least min_amplitude() at the lowest wavenumber.
MultipleDiffractionLimits multiple_diffraction_limits(const Scatterer& scatterer, const TracingSettings& settings,
                                                      double lowest);

struct EdgeDiffractionRequest {
  const Scatterer& scatterer;
  const BistaticGeometry& geometry;
  const TracingSettings& settings;
  std::span<const double> wavenumbers;  // of the patterns, at least one
  const IlluminationByEdge& incoming;   // by the transmitter
  const IlluminationByEdge& outgoing;   // by a wave from the receiver, the same object for one antenna
  int threads = 1;
};

// Calls visit(chunk, contributions), chunk = 0..kEdgeChunks-1, with the contributions of each edge; those of a chunk
// arrive in order from one thread. Contributions rejected by the filter of the settings are omitted. Chunks do not
// depend on the number of threads.
inline constexpr std::size_t kEdgeChunks = 16;
void edge_diffraction(const EdgeDiffractionRequest& request,
                      const std::function<void(std::size_t, std::span<const Contribution>)>& visit);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Everything that sharp edges answer: single diffraction by all ways, and the edge waves that meet a second edge.

#include <span>
#include <vector>

#include "sim/scattering/illuminate.h"

namespace seaglint {

// `incoming`: what the transmitter's illumination reached, edge by edge. A receiver elsewhere needs the waves it would
// send, which are followed here. Echoes that the settings' filter leaves out are not among them. The order does not
// depend on `threads`.
std::vector<EdgeFootprint> edge_echoes(const Scatterer& scatterer, const AntennaPair& antennas,
                                       const IlluminationSettings& settings, std::span<const double> wavenumbers,
                                       std::span<const EdgeArrival> incoming, int threads);

}  // namespace seaglint

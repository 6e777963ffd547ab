// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Double diffraction: a hard-polarised wave that a sharp edge sends along a flat face runs into the face's other edges and is diffracted again
// (J. B. Keller, J. Opt. Soc. Am. 52 (1962) 116-130, section 6). It is what physical optics and single fringe currents lack on plates of a few
// wavelengths.

#include <span>
#include <vector>

#include "sim/scattering/edge_light.h"

namespace seaglint {

// Echoes along transmitter - first edge - face - second edge - receiver, for every stretch of first edges in `incoming` and of second edges in
// `outgoing` (the same list when both are one antenna), each sorted by edge. The strip of grazing rays is followed across coplanar facets; it ends
// at edges that are not sharp. Fields fall as 1/sqrt(k l) with the distance l between the edges; at the second edge half of the wave is incident.
std::vector<EdgeFootprint> edge_wave_footprints(const SharpEdges& edges, std::span<const Facet> facets, const AntennaPair& antennas,
                                                std::span<const EdgeArrival> incoming, std::span<const EdgeArrival> outgoing);

}  // namespace seaglint

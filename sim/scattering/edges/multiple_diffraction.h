// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Diffraction in a row: a hard-polarised wave that a sharp edge sends along a flat face runs into the face's other
// edges and is diffracted again, twice and three times in all (J. B. Keller, J. Opt. Soc. Am. 52 (1962) 116-130). It is
// what physical optics and single fringe currents lack on plates of a few wavelengths, and all that lets the echo of a
// sheet vanish where the field stands across it: there what one edge answers, the waves from the other take away. A
// wall that stands upright on the face sends the wave back along it, as the rims of corner reflectors see it.

#include <span>
#include <vector>

#include "sim/scattering/edges/single_diffraction.h"
#include "sim/scattering/target/panels.h"

namespace seaglint {

struct MultipleDiffractionLimits {
  // Straight runs of edges from this length on take part in edge waves; from the longer one on a wave that such a run
  // diffracts is followed further, up to the fourth diffraction.
  double min_run_m = 0, min_run_high_order_m = 0;
  double min_amplitude_m = 0;  // echoes that cannot reach this are left out, judged at
  double k = 1;                // this wavenumber, 1/m
};

// Appends the echoes along transmitter - first edge - face - second edge (- face - third edge) - receiver, for every
// stretch of first edges in `incoming` and of last edges in `outgoing`. The strip of grazing rays is followed across
// coplanar facets and by up to two upright walls from one edge to the next; it ends at edges that are not sharp. A
// corner sends waves, and sends them on, as an edge does, since where what its walls send to one another grazes one of
// them physical optics knows no penumbra; ways that end in one are those of trace_diffraction_to_concave_edges. Fields
// fall as 1/sqrt(k l) with the distance l between two edges; at the later one half of the wave is incident.
void trace_multiple_diffraction(const SharpEdges& edges, std::span<const Facet> facets, const Panels& panels,
                                const BistaticGeometry& geometry, EdgeIlluminations incoming,
                                const IlluminationByEdge& outgoing, const MultipleDiffractionLimits& limits,
                                std::vector<EdgeContribution>& contributions);

// The same of ways that end in a corner: transmitter - first edge - face - corner - receiver, for corners in
// `outgoing`, found from there on (reciprocity). Ways from corner to corner are in neither.
void trace_diffraction_to_concave_edges(const SharpEdges& edges, std::span<const Facet> facets, const Panels& panels,
                                        const BistaticGeometry& geometry, const IlluminationByEdge& incoming,
                                        EdgeIlluminations outgoing, const MultipleDiffractionLimits& limits,
                                        std::vector<EdgeContribution>& contributions);

}  // namespace seaglint

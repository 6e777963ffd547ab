// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Multiple diffraction: a sharp edge launches a hard-polarised diffracted wave along a flat face; the wave grazes to
// the other edges of the face and is diffracted again, up to four times in all (J. B. Keller, J. Opt. Soc. Am. 52
// (1962) 116-130). PO and single fringe currents lack this field on plates of a few wavelengths. It cancels the field
// of the first edge where the echo of a sheet must vanish, as for an incident E normal to a sheet in its own plane. A
// wall perpendicular to the face reflects the wave back along it, as in corner reflectors.

#include <span>
#include <vector>

#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/edge_illumination.h"

namespace seaglint {

struct MultipleDiffractionLimits {
  // Minimum length of straight runs of edges for double diffraction, and for orders three and four, m.
  double min_run_m = 0, min_run_high_order_m = 0;
  double min_amplitude_m = 0;  // contributions that cannot reach this amplitude are omitted, evaluated at k
  double k = 1;                // 1/m
};

// Scene of the grazing waves of one observation.
struct GrazingWaves {
  const Scatterer& scatterer;
  const BistaticGeometry& geometry;
  std::span<const double> wavenumbers;  // of the patterns of thick sheets
  const IlluminationByEdge& outgoing;   // intervals of last edges, by a wave from the receiver
  MultipleDiffractionLimits limits;
};

// Appends the contributions transmitter - first edge - face - second edge (- face - third edge ...) - receiver, for all
// intervals of first edges in `incoming` and of last edges in the scene. The strip of grazing rays is followed across
// coplanar facets and via up to two perpendicular walls to the next edge; it ends at edges that are not sharp. Concave
// edges launch and relaunch waves too, because PO has no transition region where a wave reflected by one wall grazes
// the other; for one antenna such a double diffraction includes its reciprocal, which ends at the concave edge. Fields
// decay as 1/sqrt(k l) with the distance l between two edges; at the later edge half of the field is the incident
// field.
void trace_multiple_diffraction(const GrazingWaves& scene, EdgeIlluminations incoming,
                                std::vector<Contribution>& contributions);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Decomposition of a contribution into points that hold over a band and a small aspect change. A closed form may not be
// frozen while its phase changes by cycles; its end-point contributions may (radiation/README.md).

#include <vector>

#include "sim/scattering/points/point.h"

namespace seaglint {

// Appends the points of a contribution, about the phase origin of the observation. At the nodes and the traced direction
// the sum of amplitude pattern e^{jk psi} is the contribution to rounding, elsewhere amplitudes are frozen. Let u be the
// aspect change times the change of psi's slope along the panel or the edge: an area is replaced by its sides where that
// slope exceeds u / kMaxAmplitudeError, a side or an edge by its end points where its own slope does; otherwise they are
// divided into pieces whose own phase stays below kMaxHalfPhase. The relative error is at most kMaxAmplitudeError per
// end point, and |k / k_node - 1| beyond the nodes of a band. At a single node and direction a flat footprint or an interval is one point.
//
// Reciprocity and the curvature of the wavefront enter here. At a finite range each path is longer by |x_perp|^2 / (2 R),
// x measured from the point that the range refers to (CONVENTIONS.md, "Plane waves"). Its first order about a
// footprint's centroid tilts the phase and decides with it on the form; its second order is a change of aspect by the
// footprint's extent over R. The slide of a shadow boundary along the curved front is neglected.
void decompose(const Contribution& contribution, const Observation& observation, const PointBand& at,
               std::vector<Point>& out);

// The contribution at the wavenumber k, the node of its patterns `node`: the sum of its points there.
ScatteringMatrix scattered(const Contribution& contribution, const Observation& observation, double k,
                           std::size_t node = 0);

// False where the amplitude law oscillates over the band, so that its nodes do not determine it.
bool varies_slowly(const Contribution& contribution, const FrequencyBand& band);

}  // namespace seaglint

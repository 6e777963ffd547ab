// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Decomposition of a footprint for a radar at a finite range.

#include <vector>

#include "sim/scattering/points/point_contributions.h"

namespace seaglint {

// Over a curved wavefront the slope of psi changes along a panel also where it does not with the look direction, as in
// a corner that returns the wave as it came.
Footprint at_any_slope_rate(Footprint footprint);

// Appends the points of a footprint, body at rest, with the wavefront's curvature (apply_wavefront_curvature());
// radar.range_m > 0. The first order of the curvature about the footprint's centroid tilts its phase and decides with
// it on the form of the decomposition; only the second order, over the footprint's own extent d, changes with the
// place: amplitudes are frozen over an aspect change of d / R, whatever the size of the target, and that of the
// settings.
void decompose_at_range(const Footprint& footprint, const BistaticGeometry& geometry, const FrequencyBand& band,
                        const RadarRange& radar, std::vector<BandPoint>& out);
void decompose_at_range(const Footprint& footprint, const BistaticGeometry& geometry,
                        const DecompositionSettings& settings, const RadarRange& radar,
                        std::vector<PointContribution>& out);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Decomposition of a footprint for a radar at a finite range.

#include <vector>

#include "sim/scattering/surfaces/point_contributions.h"

namespace seaglint {

// Appends the points of a footprint for a sweep, body at rest, with the wavefront's curvature
// (apply_wavefront_curvature()); radar.range_m > 0. The first order of the curvature about the footprint's centroid
// tilts its phase and decides with it on the form of the decomposition; only the second order, over the footprint's own
// extent d, changes with the place: amplitudes are frozen over an aspect change of d / R, whatever the size of the
// target.
void decompose_at_range(const Footprint& footprint, const BistaticGeometry& geometry, const FrequencyBand& band,
                        const RadarRange& radar, std::vector<BandPoint>& out);

}  // namespace seaglint

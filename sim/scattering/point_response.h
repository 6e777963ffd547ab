// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Ideal scatterers, for teaching and for testing the radar chain alone.

#include <span>

#include "sim/scattering/frequency_response.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// Unit vector from the target to the radar in the target frame (CONVENTIONS.md, "Frames").
Vec3 direction_to_radar(const View& view);

// H = sum of amplitude e^{+j 2 k r^.x(t)}, x(t) = position + velocity (t - t_0), t_0 the first pulse's time; all
// polarisations alike.
FrequencyResponse point_response(std::span<const PointSpec> points, const Vec3& r_hat,
                                 const IntervalSampling& sampling);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Ideal scatterers, for teaching and for testing the radar chain alone.

#include <span>

#include "sim/scattering/response/frequency_response.h"
#include "sim/scattering/response/sea_reflection.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// H = sum of amplitude e^{+j 2 k r^.x(t)}, x(t) = position + velocity (t - t_0), t_0 the first pulse's time; all
// polarisations alike.
FrequencyResponse point_response(std::span<const PointSpec> points, const Vec3& r_hat,
                                 const IntervalSampling& sampling);

// The same over the sea mirror (sea_reflection.h), z = 0 of the target frame: H = sum of amplitude (e^{jk r^.x} + rho_p
// e^{jk r'.x}) (e^{jk r^.x} + rho_q e^{jk r'.x}) for p received and q transmitted, less the paths not wanted.
FrequencyResponse point_response_over_sea(std::span<const PointSpec> points, const Vec3& r_hat,
                                          const IntervalSampling& sampling, Polarisation polarisation,
                                          const SeaReflection& sea);

}  // namespace seaglint

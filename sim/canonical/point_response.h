// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Ideal point scatterers, for teaching and for tests of the radar chain.

#include <span>

#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/observation/sea_reflection.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// H = sum of amplitude e^{+j 2 k r^.x(t)}, x(t) = position + velocity (t - t_0), t_0 the time of the first pulse; equal
// for all polarisations.
FrequencyResponse point_response(std::span<const PointSpec> points, const Vec3& r_hat,
                                 const IntervalSampling& sampling);

// The same with specular sea reflection at z = 0 of the target frame (sea_reflection.h): H = sum of amplitude (e^{jk
// r^.x} + rho_p e^{jk r'.x}) (e^{jk r^.x} + rho_q e^{jk r'.x}) for p received and q transmitted, restricted to the
// enabled propagation paths; over waves (surface_propagation.h) each point has its own amplitudes in the place of 1 and
// rho.
FrequencyResponse point_response_over_sea(std::span<const PointSpec> points, const Vec3& r_hat,
                                          const IntervalSampling& sampling, Polarisation polarisation,
                                          const SeaReflection& sea);

}  // namespace seaglint

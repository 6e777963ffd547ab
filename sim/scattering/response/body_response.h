// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The response of one rigid body over one coherent interval.

#include <vector>

#include "sim/motion/kinematics/trajectory.h"
#include "sim/scattering/response/frequency_response.h"
#include "sim/scattering/response/sea_reflection.h"
#include "sim/scattering/target/scatterer.h"
#include "sim/scenario/radar_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct BodyResponse {
  FrequencyResponse response;
  int traces = 0;  // directions that were lit
};

// The turn of a body that one trace serves when the scenario leaves it open, rad: the target's ends may move by 6
// wavelengths, two ways together, and never more than 0.15 deg. Ship at 16 GHz: 0.044 deg.
double default_aspect_change(const Scatterer& scatterer, double wavelength);

// H(f, attitude at t_n) of a body on its trajectory, seen along r_hat (target frame). One trace serves pulses while the
// body turns by at most solver.max_aspect_change_deg; a faster body is traced at the middles of spans that short, and
// neighbouring traces are blended linearly in time; spans get shorter still where the direction's path bends by more
// than a grid takes. Error against a fresh trace per pulse and frequency: sim/scattering/README.md. Polarisation basis:
// that of the world, turned into the body at each trace. A radar at
// solver.wavefront_range_m from the target frame's origin is seen by the body from where it stands. The trajectory must
// cover the interval. With `sea` the echo comes four ways over the surface z = 0 of the target frame
// (sea_reflection.h), each traced by itself; r_hat.z() > 0.
BodyResponse body_response(const Scatterer& scatterer, const Trajectory& trajectory, const Vec3& r_hat,
                           Polarisation polarisation, const IntervalSampling& sampling, const SolverSpec& solver,
                           int threads = 1, const SeaReflection* sea = nullptr);

}  // namespace seaglint

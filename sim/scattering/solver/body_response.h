// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Frequency response of one rigid body over one coherent interval.

#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/observation/sea_reflection.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/solver/shared_traces.h"
#include "sim/scenario/radar_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct BodyResponse {
  FrequencyResponse response;
  int traces = 0;  // aspect traces, over all spans and propagation paths; those shared by intervals count as one
};

// Default aspect change that one trace serves, rad: min(0.15 deg, 3 wavelength / radius), a two-way displacement of 6
// wavelengths at the ends of the target. 144 m ship at 16 GHz: 0.044 deg.
double default_aspect_change(const Scatterer& scatterer, double wavelength);

// H(f, attitude at t_n) of a body on its trajectory, observed along r_hat (target frame). One aspect trace serves the
// pulses within an aspect change of solver.max_aspect_change_deg. A faster body is traced at the middles of spans of
// that length, and the responses of neighbouring traces are interpolated linearly in time; spans are shortened further
// where the cross-track phase exceeds kMaxCrossTrackPhase. The error relative to an independent trace per pulse and
// frequency is in README.md. The polarisation basis is that of the world frame, rotated into the body at each trace.
// With solver.wavefront_range_m > 0 the radar is at that distance from the origin of the target frame, and the body is
// observed from its own position. The trajectory must cover the interval. `sea`: adds the specular sea reflection at z
// = 0 of the target frame (sea_reflection.h) with one trace per propagation path; requires r_hat.z() > 0. With
// solver.shared_traces slow intervals use the traces of a lattice of look directions (shared_traces.h), which `shared`,
// of this scatterer and these solver settings, keeps for other intervals; the response is the same without it. Throws
// Interrupted when *stop becomes true.
BodyResponse body_response(const Scatterer& scatterer, const Trajectory& trajectory, const Vec3& r_hat,
                           Polarisation polarisation, const IntervalSampling& sampling, const SolverSpec& solver,
                           int threads = 1, const SeaReflection* sea = nullptr, const StopFlag* stop = nullptr,
                           SharedTraces* shared = nullptr);

}  // namespace seaglint

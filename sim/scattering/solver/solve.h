// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The solver: scattering matrices of a body at rest in one or several views, over a sweep of frequencies, also over the
// sea; and the frequency response of a moving body over a coherent interval.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/observation/sea_reflection.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/sums/view_estimate.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "sim/scenario/radar_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// The mean sea surface under a body at rest.
struct SeaUnderBody {
  SeaReflection reflection;
  double height_m = 0;  // of the body's origin above the surface
};

// Views of a body at rest. Only the scatterer, views and wavenumbers are required.
struct SolveRequest {
  const Scatterer& scatterer;
  std::vector<BistaticGeometry> views;  // every transmit direction is traced once
  std::vector<double> wavenumbers;      // rad/m, in any order
  TracingSettings settings = {};
  RadarRange radar = {};                 // at a finite range; over the sea from the point of the surface below the body
  std::optional<SeaUnderBody> sea = {};  // four propagation paths; of views of one antenna above the surface
  bool one_way = false;                  // hv and vh as the beams have them, equal only to the accuracy of the method
  bool estimates = false;                // uncertainty, at the frequency nearest to the middle of the sweep
  bool by_part = false;                  // also the matrices of every part
  std::optional<double> points_for_rad = {};  // points that hold over this aspect change; of one wavenumber, no sea
  int threads = 1;
  const StopFlag* stop = nullptr;
};

struct ViewResult {
  // hh, hv, vh, vv (received, transmitted) in metres at each wavenumber. Phase origin: the body's origin. Each
  // direction has its own polarisation basis. For one antenna hv = vh, the mean of both (Reciprocity).
  Matrices matrices;
  std::optional<ViewEstimate> estimate;
  std::vector<Point> points;  // in an order independent of the number of threads; their direct sum is the matrix
  // Of a request `by_part`: the coherent sum of the contributions of one part, by its index in the mesh. A reflection
  // belongs to the part that it leaves last, an edge to the part of its first facet. The sum over the parts is
  // `matrices`; parts without contributions are not in it.
  std::map<std::uint16_t, Matrices> parts;
};

struct SolveResult {
  std::vector<ViewResult> views;
  std::size_t segments = 0;  // beam segments traced from transmitters
};

// Every footprint's exact phase integral at every wavenumber from one trace. Throws Interrupted when *stop becomes
// true, InputError as observation_of().
SolveResult solve(const SolveRequest& request);

// A body on its trajectory, observed over a coherent interval.
struct IntervalRequest {
  const Scatterer& scatterer;
  const Trajectory& trajectory;  // covers the interval
  Vec3 r_hat = Vec3::UnitX();    // target frame; above the sea where that reflects
  Polarisation polarisation = Polarisation::kHh;
  const IntervalSampling& sampling;
  SolverSpec solver = {};
  const SeaReflection* sea = nullptr;  // the specular reflection of z = 0 of the target frame; null: none
  int threads = 1;
  const StopFlag* stop = nullptr;
};

struct IntervalResult {
  FrequencyResponse response;
  int traces = 0;  // aspect traces, over all spans and propagation paths
};

// H(f, attitude at t_n). One aspect trace serves the pulses within an aspect change of solver.max_aspect_change_deg. A
// faster body is traced at the middles of spans of that length, and the responses of neighbouring traces are
// interpolated linearly in time; spans are shortened further where the cross-track phase exceeds kMaxCrossTrackPhase.
// The error relative to an independent trace per pulse and frequency is in README.md. The polarisation basis is that of
// the world frame, rotated into the body at each trace. With solver.wavefront_range_m > 0 the radar is at that distance
// from the origin of the target frame, and the body is observed from its own position. Throws Interrupted when *stop
// becomes true.
IntervalResult solve(const IntervalRequest& request);

// Default aspect change that one trace serves, rad: min(0.15 deg, 3 wavelength / radius), a two-way displacement of 6
// wavelengths at the ends of the target. 144 m ship at 16 GHz: 0.044 deg.
double default_aspect_change(const Scatterer& scatterer, double wavelength);

}  // namespace seaglint

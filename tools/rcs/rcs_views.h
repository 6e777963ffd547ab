// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Computes scattering matrices over the frequencies and aspects of a request. Every aspect of one antenna is traced by
// itself, several in parallel; the aspects of a fixed transmitter are traced together.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/solver/solve.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// Polarisation basis of an antenna in that direction; at elevations of +-90 deg h is that of the same azimuth at lower
// elevations, phi^ of a spherical table.
RadarBasis basis_at(double azimuth_deg, double elevation_deg);

// Tracing settings of the request, with or without edge diffraction: for all contributions, or those that its target
// selects.
TracingSettings settings_of(const RcsRequest& request, bool edge_diffraction);
TracingSettings settings_of(const RcsRequest& request, const RcsTarget& target, bool edge_diffraction);

// One view of a sweep at one frequency.
struct RcsView {
  double azimuth_deg = 0, elevation_deg = 0, frequency_hz = 0;
};

// The requested model of one view of the target, without the sea and its cavities, with its points and estimate. Throws
// Interrupted when *stop becomes true.
SolveResult view_contributions(const RcsRequest& request, const RcsTarget& target, const RcsView& view, int threads = 1,
                               const StopFlag* stop = nullptr);

struct RcsResult {
  RcsSweep sweep;             // the requested model is the last
  std::vector<Point> points;  // of the requested model, for a request with exports
  std::size_t segments = 0;   // beam segments traced from transmitters
};

// Azimuths of the request, each replaced by `average` of them, evenly spread over the step about it.
std::vector<double> averaged_azimuths(const RcsRequest& request);

// Computes all models of the request, on `threads` threads (0 = all processors). Throws WorkError when a cavity's
// currents do not converge or *stop becomes true. say(), if any, gets a line with the time that a long sweep will take,
// by its first views. With `average` above 1 the amplitudes are positive ones with the mean of |S|^2, without phases,
// and there are no estimates.
RcsResult compute_rcs(const RcsRequest& request, const RcsTarget& target, int threads = 0,
                      const StopFlag* stop = nullptr, const std::function<void(const std::string&)>& say = {});

}  // namespace seaglint

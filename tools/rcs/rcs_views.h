// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scattering matrices over the frequencies and aspects of a request, view by view.

#include <cstddef>

#include "sim/core/process/parallel.h"
#include "sim/scattering/beams/illumination_settings.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_sweep.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

// Of an antenna there; at the zenith and below the keel h is that of the azimuth's lower elevations, phi^ of a
// spherical table.
RadarBasis basis_at(double azimuth_deg, double elevation_deg);

// How the request's target is illuminated, with edge diffraction or without.
TracingSettings settings_of(const RcsRequest& request, const RcsTarget& target, bool edge_diffraction);

struct RcsResult {
  RcsSweep sweep;            // the request's own model last
  std::size_t segments = 0;  // of beams followed
};

// Computes all models of the request, on `threads` threads (0 = all processors). Throws WorkError when a cavity has no
// answer or *stop becomes true.
RcsResult compute_rcs(const RcsRequest& request, const RcsTarget& target, int threads = 0,
                      const StopFlag* stop = nullptr);

}  // namespace seaglint

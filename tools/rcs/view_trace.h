// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scattering matrix and point contributions of one view at one frequency, from one trace.

#include <array>
#include <cstddef>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/beams/illumination_settings.h"
#include "sim/scattering/surfaces/point_contributions.h"
#include "sim/scattering/target/scatterer.h"

namespace seaglint {

struct TracedView {
  std::array<Complex, 4> matrix{};               // as scattering_matrices() returns it, m
  std::vector<PointContribution> contributions;  // as aspect_contributions() returns them
  std::size_t segments = 0;                      // beam segments traced
};

// Traces the view and sums its contributions at wavenumber k. The points hold over the default aspect change
// (body_response.h). Throws InputError for a range of the settings below ten times the reach of the target, Interrupted
// when *stop becomes true.
TracedView trace_view(const Scatterer& scatterer, const BistaticGeometry& geometry, double k,
                      const TracingSettings& settings, int threads = 1, const StopFlag* stop = nullptr);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scattering matrix of a body at rest, and the contributions of which it is the sum.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/observation/bistatic_geometry.h"
#include "sim/scattering/observation/sea_reflection.h"
#include "sim/scattering/points/point_contributions.h"
#include "sim/scattering/sums/view_estimate.h"
#include "sim/scattering/tracing/illumination_settings.h"

namespace seaglint {

// e^{jk (r_t + r_s) . c}, c the scatterer's centre: from the phase about its centre, about which contributions are
// computed, to that about the body's origin.
Complex origin_phase(const Scatterer& scatterer, const BistaticGeometry& geometry, double k);

// Largest difference of the direction to the radar over the target, rad; 0 in the far field (range_m = 0).
// radar.origin: the scatterer's centre relative to the point that the range refers to. Throws InputError when the range
// is below ten times the reach of the target from that point.
double direction_spread(const Scatterer& scatterer, const RadarRange& radar);

// hh, hv, vh, vv (received, transmitted) in metres at each wavenumber, body at rest: one trace, and the exact phase
// integral of every footprint at every wavenumber. Phase origin: the body's origin. Each direction has its own
// polarisation basis. For one antenna hv = vh, the mean of both (reciprocity.h). Adds the number of beam segments
// traced to *segments.
std::vector<std::array<Complex, 4>> scattering_matrices(const Scatterer& scatterer, const BistaticGeometry& geometry,
                                                        std::span<const double> wavenumbers,
                                                        const TracingSettings& settings, int threads = 1,
                                                        std::size_t* segments = nullptr, const StopFlag* stop = nullptr,
                                                        const RadarRange& radar = {});

// The same for each pair of directions; every transmit direction is traced once (aspect_trace.h). Appends the estimate
// of each pair, at the frequency nearest to the middle of the sweep, to *estimates.
std::vector<std::vector<std::array<Complex, 4>>> scattering_matrices(
    const Scatterer& scatterer, std::span<const BistaticGeometry> pairs, std::span<const double> wavenumbers,
    const TracingSettings& settings, int threads = 1, std::size_t* segments = nullptr, const StopFlag* stop = nullptr,
    const RadarRange& radar = {}, std::vector<ViewEstimate>* estimates = nullptr);

// The same with hv and vh of one antenna as the beams have them, equal only to the accuracy of the method.
std::vector<std::vector<std::array<Complex, 4>>> one_way_matrices(
    const Scatterer& scatterer, std::span<const BistaticGeometry> pairs, std::span<const double> wavenumbers,
    const TracingSettings& settings, int threads = 1, std::size_t* segments = nullptr, const StopFlag* stop = nullptr,
    const RadarRange& radar = {}, std::vector<ViewEstimate>* estimates = nullptr);

// hh, hv, vh, vv in metres of a body at rest over the sea, at each wavenumber, with the phase referred to the body's
// origin, `height_m` above the mean surface. r_hat in the body frame, z up, r_hat.z() > 0; range_m from the point of
// the mean surface below the body, 0: plane wave. Adds the number of beam segments traced to *segments; *estimate
// becomes that of the view.
std::vector<std::array<Complex, 4>> scattering_matrices_over_sea(const Scatterer& scatterer, const Vec3& r_hat,
                                                                 double height_m, const SeaReflection& sea,
                                                                 std::span<const double> wavenumbers,
                                                                 const TracingSettings& settings, int threads = 1,
                                                                 std::size_t* segments = nullptr,
                                                                 const StopFlag* stop = nullptr, double range_m = 0,
                                                                 ViewEstimate* estimate = nullptr);

// Point contributions of one aspect, and their sum in closed form.
struct AspectContributions {
  std::vector<PointContribution> points;  // in an order independent of the number of threads
  std::array<Complex, 4> matrix{};        // hh, hv, vh, vv at split.kc, as scattering_matrices() returns it, m
  std::size_t segments = 0;               // beam segments traced
  ViewEstimate estimate;
};

// The direct sum of the points at split.kc is the scattering matrix, to the error of their decomposition.
AspectContributions aspect_contributions(const Scatterer& scatterer, const BistaticGeometry& geometry,
                                         const DecompositionSettings& split, const TracingSettings& settings,
                                         int threads = 1, const StopFlag* stop = nullptr, const RadarRange& radar = {});

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The scattering matrix of a body at rest, and the contributions that it is the sum of.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/beams/illumination_settings.h"
#include "sim/scattering/response/sea_reflection.h"
#include "sim/scattering/surfaces/point_contributions.h"

namespace seaglint {

// The radar stands in directions that differ by this much over the target, rad; 0 in the far field. Throws InputError
// when it is too near.
double direction_spread(const Scatterer& scatterer, double range_m, const Vec3& origin);

// hh, hv, vh, vv (received, transmitted) in metres at each wavenumber, body at rest: one trace, and the exact phase
// integral of every footprint at every frequency. Each direction has its own basis. Raises *legs by the legs of beams
// followed.
std::vector<std::array<Complex, 4>> scattering_matrices(const Scatterer& scatterer, const BistaticGeometry& geometry,
                                                        std::span<const double> wavenumbers,
                                                        const TracingSettings& settings, int threads = 1,
                                                        std::size_t* segments = nullptr,
                                                        const StopFlag* stop = nullptr);

// The same for each pair of directions. Every transmit direction is traced once.
std::vector<std::vector<std::array<Complex, 4>>> scattering_matrices(
    const Scatterer& scatterer, std::span<const BistaticGeometry> pairs, std::span<const double> wavenumbers,
    const TracingSettings& settings, int threads = 1, std::size_t* segments = nullptr, const StopFlag* stop = nullptr);

// The scattering matrix hh, hv, vh, vv in metres of a body at rest over the sea, at each wavenumber, about the body's
// origin, which is `height_m` above the mean surface. r_hat in the body frame, whose z is up; r_hat.z() > 0. Raises
// *legs by the legs followed.
std::vector<std::array<Complex, 4>> scattering_matrices_over_sea(const Scatterer& scatterer, const Vec3& r_hat,
                                                                 double height_m, const SeaReflection& sea,
                                                                 std::span<const double> wavenumbers,
                                                                 const TracingSettings& settings, int threads = 1,
                                                                 std::size_t* segments = nullptr,
                                                                 const StopFlag* stop = nullptr);

// What one view consists of, point by point, in an order that does not depend on the number of threads. Their direct
// sum at split.kc is the scattering matrix.
std::vector<PointContribution> aspect_contributions(const Scatterer& scatterer, const BistaticGeometry& geometry,
                                                    const DecompositionSettings& split, const TracingSettings& settings,
                                                    int threads = 1, const StopFlag* stop = nullptr);

}  // namespace seaglint

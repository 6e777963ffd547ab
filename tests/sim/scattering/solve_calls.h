// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Short forms of solve() for the requests of tests and benchmarks.

#include <memory>
#include <span>
#include <vector>

#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "sim/scattering/solver/solve.h"

namespace seaglint {

// Matrices of every pair, per wavenumber.
inline std::vector<Matrices> matrices_of(SolveRequest request) {
  std::vector<Matrices> all;
  for (ViewResult& view : solve(request).views) all.push_back(std::move(view.matrices));
  return all;
}

inline SolveRequest views_request(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs,
                                  std::span<const double> wavenumbers, const TracingSettings& settings, int threads = 1,
                                  const RadarRange& radar = {}) {
  return {.scatterer = scatterer,
          .views = {pairs.begin(), pairs.end()},
          .wavenumbers = {wavenumbers.begin(), wavenumbers.end()},
          .settings = settings,
          .radar = radar,
          .threads = threads};
}

inline std::vector<Matrices> scattering_matrices(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs,
                                                 std::span<const double> wavenumbers, const TracingSettings& settings,
                                                 int threads = 1, const RadarRange& radar = {}) {
  return matrices_of(views_request(scatterer, pairs, wavenumbers, settings, threads, radar));
}

inline Matrices scattering_matrices(const Scatterer& scatterer, const BistaticGeometry& geometry,
                                    std::span<const double> wavenumbers, const TracingSettings& settings,
                                    int threads = 1, const RadarRange& radar = {}) {
  return scattering_matrices(scatterer, std::span(&geometry, 1), wavenumbers, settings, threads, radar).front();
}

inline std::vector<Matrices> one_way_matrices(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs,
                                              std::span<const double> wavenumbers, const TracingSettings& settings) {
  SolveRequest request = views_request(scatterer, pairs, wavenumbers, settings);
  request.one_way = true;
  return matrices_of(request);
}

inline SolveRequest over_sea_request(const Scatterer& scatterer, const Vec3& r_hat, const SeaUnderBody& sea,
                                     std::span<const double> wavenumbers, const TracingSettings& settings) {
  const BistaticGeometry view = monostatic(radar_basis(r_hat));
  SolveRequest request = views_request(scatterer, std::span(&view, 1), wavenumbers, settings);
  request.sea = sea;
  return request;
}

inline Matrices matrices_over_sea(const Scatterer& scatterer, const Vec3& r_hat, const SeaUnderBody& sea,
                                  std::span<const double> wavenumbers, const TracingSettings& settings) {
  return matrices_of(over_sea_request(scatterer, r_hat, sea, wavenumbers, settings)).front();
}

// Points, matrix and estimate of one view at one wavenumber.
inline ViewResult points_of(const Scatterer& scatterer, const BistaticGeometry& geometry, double k,
                            double aspect_change_rad, const TracingSettings& settings, int threads = 1) {
  return solve({.scatterer = scatterer,
                .views = {geometry},
                .wavenumbers = {k},
                .settings = settings,
                .estimates = true,
                .points_for_rad = aspect_change_rad,
                .threads = threads})
      .views.front();
}

// A contribution as it is traced, about the scatterer's centre.
inline ScatteringMatrix scattered(const Contribution& contribution, const BistaticGeometry& antennas, double k) {
  return scattered(contribution, {.antennas = antennas, .sense = PathSense::kOneWay}, k);
}

// Illumination for one receiver.
inline Illumination illumination(const Scatterer& scatterer, const BistaticGeometry& antennas,
                                 const TracingSettings& settings, std::span<const double> wavenumbers = {}) {
  const auto along = [&](const RadarBasis& direction) {
    return std::make_shared<const Aspect>(scatterer, direction, settings, 1);
  };
  return {scatterer,
          {along(antennas.transmit), {antennas.monostatic ? nullptr : along(antennas.receive)}},
          settings,
          wavenumbers};
}

inline void ignore_contributions(std::size_t, std::size_t, std::span<const Contribution>) {}

// Response of a body over an interval. The arguments must outlive the call only.
inline IntervalResult interval_response(const Scatterer& scatterer, const Trajectory& trajectory, const Vec3& r_hat,
                                        Polarisation polarisation, const IntervalSampling& sampling,
                                        const SolverSpec& solver = {}, int threads = 1,
                                        const SeaReflection* sea = nullptr) {
  return solve({.scatterer = scatterer,
                .trajectory = trajectory,
                .r_hat = r_hat,
                .polarisation = polarisation,
                .sampling = sampling,
                .solver = solver,
                .sea = sea,
                .threads = threads});
}

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Short cuts shared by the scattering tests.

#include <array>
#include <cmath>

#include "sim/core/constants.h"
#include "sim/scattering/respond.h"

namespace seaglint::testing_echoes {

inline double wavenumber(double frequency_hz) { return 2 * kPi * frequency_hz / kSpeedOfLight; }

inline double dbsm(const Complex& s) { return 10 * std::log10(4 * kPi * std::norm(s)); }

inline Vec3 direction(double azimuth_deg, double elevation_deg) {
  const double az = radians(azimuth_deg), el = radians(elevation_deg);
  return {std::cos(el) * std::cos(az), std::cos(el) * std::sin(az), std::sin(el)};
}

inline std::array<Complex, 4> echo(const Scatterer& scatterer, const RadarBasis& basis, double k, double spacing = 0,
                                   int bounces = 8, bool edges = false) {
  return scattering_matrices(scatterer, monostatic(basis), std::array{k}, {spacing, bounces, edges})[0];
}

inline std::array<Complex, 4> echo(const TriangleMesh& mesh, const Vec3& r_hat, double k, double spacing = 0,
                                   int bounces = 8) {
  return echo(Scatterer(mesh), radar_basis(r_hat), k, spacing, bounces);
}

enum Channel { kHhChannel, kHvChannel, kVhChannel, kVvChannel };

}  // namespace seaglint::testing_echoes

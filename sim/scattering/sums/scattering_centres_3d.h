// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scattering centres of one aspect, and the contribution of every facet.

#include <array>
#include <span>
#include <vector>

#include "sim/scattering/points/decomposition.h"

namespace seaglint {

// The points of one cell as one: S(k', r^ + d) = amplitude e^{j(k' - k) psi + jk' gradient . d} about the
// traced k and r^.
struct ScatteringCentre3d {
  Vec3 gradient = Vec3::Zero();  // of psi with the look direction, m; half of it is the phase centre, body frame
  double psi = 0;                // minus the two-way path, m
  ScatteringMatrix amplitude{};  // hh, hv, vh, vv at k and r^, with phase, m
  std::uint16_t part = 0;
  std::uint8_t bounces = 1;
  Mechanism mechanism = Mechanism::kPhysicalOptics;

  Vec3 position() const { return gradient / 2; }
  double peak_rcs() const;  // 4 pi times the largest |element|^2, m^2
};

// Clusters points of one part, bounce count and mechanism whose psi and gradient share a cell of 2 cell_m
// (cell_m in range and position) into one centre at their mean, weighted by |amplitude|; strongest first. At k and r^
// the centres have the sum of the points to rounding; at dk and d off it the error is at most sum |amplitude|
// (|dk| 2 cell_m + (k + |dk|) |d| sqrt(3) 2 cell_m).
std::vector<ScatteringCentre3d> cluster_centres(std::span<const Point> points, double k, double cell_m);

// hh, hv, vh, vv in metres of each facet at k, with phases; their sum is the scattering matrix.
Matrices facet_contributions(std::span<const Point> points, double k, std::size_t facets);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Vertices of the smooth surfaces that a mesh approximates, and the surface normals there.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/smooth_sides.h"

namespace seaglint {

// A vertex belongs to one smooth fan of facets; one on a sharp edge occurs once for each side.
struct SmoothVertices {
  std::vector<std::array<std::int32_t, 3>> of_facet;  // vertices at the corners
  std::vector<Vec3> normal;                           // unit
  std::vector<std::int32_t> first, fan;               // facets of vertex i: fan[first[i] .. first[i + 1])
  // Of every facet, m: width of its planar face, sqrt(12 times the least second moment of its area / area), the smaller
  // side of a rectangle; of a facet of no known face, its height over the longest side.
  std::vector<double> facet_width;
};

// The normal is that of the file where one is given, else the mean over the fan by corner_weight(): with the weights
// for similar widths where the largest width is at most twice the smallest, with the others from three times on, with a
// smooth transition between.
SmoothVertices smooth_vertices(std::span<const Facet> facets, const SmoothSides& smooth);

// Weight of a facet at one of its corners, corner_weight().
double facet_weight(const Facet& facet, int corner, double width, bool alike);

}  // namespace seaglint

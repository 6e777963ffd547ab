// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sides of facets across which the target is one smooth surface.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/facets.h"

namespace seaglint {

// Facet that continues a facet smoothly across each of its sides; -1 where the side is a knuckle, an edge or free.
using SmoothSides = std::vector<std::array<std::int32_t, 3>>;

// Sides where exactly two facets of one orientation meet and their normals differ by less than the crease angle,
// 0 <= crease <= pi rad; none for 0.
SmoothSides smooth_sides_by_angle(std::span<const Facet> facets, double crease);

// The same sides, but those only where the facets are samples of one curved surface: on a line square to the side the
// turn goes on at the distance of the facets' own size, on one side at least, and most sides nearby do so (README.md,
// "Smooth surface").
SmoothSides smooth_sides_by_shape(std::span<const Facet> facets, double crease);

// Sides of the same kind where the corner normals of both facets are given and agree.
SmoothSides smooth_sides_by_normals(std::span<const Facet> facets);

// True where the corner normals of a mesh describe a smooth surface: some are off their triangles' own, so that they do
// not repeat the facets, and none by more than kMaxNormalDeviation but for a hundredth of the area, so that they are
// not the shading of a box.
inline constexpr double kMaxNormalDeviation = 0.53;  // rad: 30 deg, a cylinder of six sides, and the digits of normals
bool normals_describe_surface(const TriangleMesh& mesh);

}  // namespace seaglint

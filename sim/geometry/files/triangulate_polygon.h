// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Triangulation of the polygons of mesh files: fans of convex polygons, ear clipping of concave ones.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Maximum number of vertices of a concave polygon: the cost is quadratic in it.
inline constexpr std::size_t kMaxConcaveVertices = 4096;

// Triangles of indices into `corner` (at least three vertices), oriented as the polygon. The fan of the first vertex
// where it covers the polygon (every convex one), and for polygons whose area is below the rounding of float32
// positions; otherwise ear clipping in the plane normal to the area vector. Vertices need not be coplanar. nullopt for
// a polygon that intersects itself, or is concave with more than kMaxConcaveVertices vertices.
std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate_polygon(std::span<const Vec3> corner);

// Error message for a polygon that is not triangulated.
std::string untriangulated_message(std::size_t corners);

}  // namespace seaglint

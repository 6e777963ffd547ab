// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Polygons of files into triangles: fans where these are right, by clipping ears where they are not.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Concave polygons with more corners are not split: the work goes with the square of their number.
inline constexpr std::size_t kMaxConcaveVertices = 4096;

// Triangles of indices into `corner` (three or more), turning as the polygon does. Where the fan from the first corner
// covers the polygon, as it does any convex one, that fan; so too for what encloses nothing but the rounding of float32
// positions. Corners need not lie in one plane: the plane is that of the polygon's area vector. Nothing where the
// polygon crosses itself, or is concave and has too many corners.
std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate_polygon(std::span<const Vec3> corner);

// What to say of a polygon that is not split.
std::string untriangulated_message(std::size_t corners);

}  // namespace seaglint

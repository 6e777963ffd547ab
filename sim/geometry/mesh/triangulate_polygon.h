// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Triangulation of polygons, by fans of convex ones and ear clipping of concave ones; the range of coordinates.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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

// Polygons of a file that are no simple polygons, counted.
struct OddPolygons {
  std::size_t too_few = 0;       // with fewer than three corners, such as edges left over: dropped
  std::size_t without_area = 0;  // that go out and back the same way: dropped
  std::size_t crossing = 0;      // that cross themselves: the fan of their first vertex
  std::size_t large = 0;         // concave with more than kMaxConcaveVertices vertices: the same
  std::string first_place{};     // of the first of them

  // One sentence per kind.
  std::vector<std::string> sentences() const;
};

// triangulate_polygon() of any polygon; one that it rejects is counted in `odd`, with place() naming its first.
std::vector<std::array<std::uint32_t, 3>> triangles_of_polygon(std::span<const Vec3> corner, OddPolygons& odd,
                                                               const std::function<std::string()>& place);

// A coordinate as it is; nullopt when not finite or beyond 1e30; 0 below 1e-30, so that its square does not vanish in
// float32.
std::optional<double> coordinate_of(double value);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The flat facets of a target as the solver sees them: planes and neighbours in double precision.

#include <array>
#include <cstdint>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct Facet {
  std::array<Vec3, 3> corner;
  Vec3 normal = Vec3::UnitZ();                        // unit, right-handed with the corners
  double offset = 0;                                  // plane: normal . x = offset
  double longest_edge = 0;                            // longest edge, m
  std::array<std::int32_t, 3> neighbour{-1, -1, -1};  // across the edge corner[i] -> corner[i+1]; -1 at a rim; the
                                                      // next of the ring where more than two facets share it
  bool two_sided = false;                             // its connected surface has a rim: either side may be seen
  std::uint16_t part = 0;
  std::uint16_t material = 0;  // of the mesh
};

// Triangles without area are left out. Neighbours are found by position, so that seams of duplicated vertices do not
// matter.
std::vector<Facet> make_facets(const TriangleMesh& mesh);

}  // namespace seaglint

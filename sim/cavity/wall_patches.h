// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Division of cavity walls into patches of nearly uniform size, independent of the triangulation.

#include <array>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct WallPatch {
  Vec3 centre;                  // m, body frame
  Vec3 normal;                  // unit, into the cavity
  std::array<Vec3, 2> tangent;  // unit, orthogonal; tangent[0] x tangent[1] = normal
  double area = 0;              // m^2
};

// Patches of about size x size. Triangles are subdivided into pieces of a third of `size` and clustered about seeds
// about `size` apart, which are then moved to the centroids of their clusters (Lloyd, IEEE Trans. IT-28, 1982,
// 129-137). The distance includes the difference of the normals, so that patches end at edges of the walls. Throws
// InputError for more than kMaxPatches.
std::vector<WallPatch> wall_patches(const TriangleMesh& walls, double size);

// At this number the currents take a quarter of an hour per frequency on two cores, and a few GB.
inline constexpr std::size_t kMaxPatches = 20'000;

}  // namespace seaglint

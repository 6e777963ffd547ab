// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The walls of a cavity as patches of about one size, however their triangles are shaped.

#include <array>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct WallPatch {
  Vec3 centre;                  // m, body frame
  Vec3 normal;                  // unit, into the cavity
  std::array<Vec3, 2> tangent;  // unit, at right angles; tangent[0] x tangent[1] = normal
  double area = 0;              // m^2
};

// Patches of about `size` squared. Triangles are cut into pieces of a third of that and gathered about seeds that lie
// apart by about `size`, then moved to the middle of what they gathered (Lloyd, IEEE Trans. IT-28, 1982, 129-137).
// Pieces that face elsewhere count as farther away, so that a patch ends at a corner of the walls. Throws InputError
// when that makes more than kMaxPatches.
std::vector<WallPatch> wall_patches(const TriangleMesh& walls, double size);

// Their currents take a quarter of an hour per frequency on two cores, and some GB.
inline constexpr std::size_t kMaxPatches = 20'000;

}  // namespace seaglint

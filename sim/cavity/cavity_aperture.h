// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The openings of a cavity: what would close the surface of its walls.

#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// A piece of an opening, without the islands that lie in it.
struct ApertureCell {
  Vec3 centre;      // m, body frame
  Vec3 inward;      // unit, into the cavity
  Vec3 across, up;  // unit, in the opening's plane; across x up = inward
  double area = 0;  // m^2
};

// The openings of `walls`, whose triangles face into the cavity, cut into cells of `pitch` metres by a lattice of each
// opening's own. Throws InputError when the walls are closed, face out of the cavity, enclose nothing or have edges of
// more than two or of opposite triangles, and when a rim is not flat to within a quarter of the pitch or touches
// itself.
std::vector<ApertureCell> aperture_cells(const TriangleMesh& walls, double pitch);

}  // namespace seaglint

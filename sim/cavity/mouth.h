// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The openings of a cavity: what would close the surface of its walls.

#include <vector>

#include "sim/geometry/triangle_mesh.h"

namespace seaglint {

// A piece of an opening. Where one rim lies within another, pieces of both overlap and cancel there: `inward` of the
// inner one points the other way.
struct MouthCell {
  Vec3 centre;        // m, body frame
  Vec3 inward;        // unit, into the cavity
  Vec3 across, up;    // unit, in the opening's plane; across x up = inward
  double area = 0;    // m^2
};

// The openings of `walls`, whose triangles face into the cavity, cut into cells of `pitch` metres by a lattice of each
// opening's own. Throws InputError when the walls are closed, when a rim is not flat to within a quarter of the pitch
// or touches itself, and when the walls face out of the cavity.
std::vector<MouthCell> mouth_cells(const TriangleMesh& walls, double pitch);

}  // namespace seaglint

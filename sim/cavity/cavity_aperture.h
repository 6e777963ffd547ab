// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Apertures of a cavity: the surfaces that would close its walls.

#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Cell of an aperture, without the islands in it.
struct ApertureCell {
  Vec3 centre;      // m, body frame
  Vec3 inward;      // unit, into the cavity
  Vec3 across, up;  // unit, in the plane of the aperture; across x up = inward
  double area = 0;  // m^2
};

// Apertures of `walls`, whose triangles face into the cavity, divided into cells of `pitch` metres by one lattice per
// aperture. Throws InputError for walls that are closed, face out of the cavity, enclose no volume, or have
// non-manifold or inconsistent edges, and for a rim that is not plane to within a quarter of the pitch or touches
// itself.
std::vector<ApertureCell> aperture_cells(const TriangleMesh& walls, double pitch);

}  // namespace seaglint

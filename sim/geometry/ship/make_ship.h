// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Mesh of a generic naval combatant of about 144 m, with the scattering features of a ship at grazing elevation; no
// particular ship.

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/ship/ship_hull.h"

namespace seaglint {

// Body frame, origin amidships on the centreline at the waterline z = 0, where the hull is cut and closed. Every part
// is closed and faces outwards, with normals where the surface is smooth; adjacent parts overlap slightly, so that no
// two faces coincide. Deterministic: equal forms give equal meshes. Throws InputError for a value out of range.
TriangleMesh make_ship(const ShipForm& form = {});

}  // namespace seaglint

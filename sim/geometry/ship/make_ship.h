// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A generic naval combatant of about 144 m: no ship in particular, but everything a radar sees of one at grazing
// elevation.

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/ship/ship_form.h"

namespace seaglint {

// Body frame, origin amidships on the centreline at the waterline z = 0, where the hull is cut and closed. Every part
// is closed and faces outwards; parts stand a little inside one another, so that no two faces coincide. The same form
// gives the same mesh. InputError for a value out of range.
TriangleMesh make_ship(const ShipForm& form = {});

}  // namespace seaglint

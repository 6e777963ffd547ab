// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Naval combatant (frigate or destroyer), laid out for 144 m by 17.5 m; no particular ship.

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/ship/fittings.h"
#include "sim/geometry/ship/hull.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Lines of the combatant of this length overall and beam at the waterline, m, without an underwater body.
HullLines combatant_lines(double length, double beam);

// Adds hull, houses, masts, weapons, deck fittings and rails. Positions along and across the ship scale with length and
// beam of the lines; fittings keep their size. rail_width: m.
void add_combatant(MeshBuilder& builder, const HullLines& lines, ShipDetail detail, double rail_width);

}  // namespace seaglint

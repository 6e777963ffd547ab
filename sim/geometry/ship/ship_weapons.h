// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Gun, vertical launchers, close-in weapon, canisters, decoy launchers.

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/ship/ship_hull.h"
#include "sim/geometry/ship/ship_superstructure.h"

namespace seaglint {

void add_weapons(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint

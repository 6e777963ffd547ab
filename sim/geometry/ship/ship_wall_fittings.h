// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Fittings on the walls: cabinets, doors, liferafts, fire stations, lamps.

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/ship/ship_hull.h"
#include "sim/geometry/ship/ship_superstructure.h"

namespace seaglint {

void add_wall_fittings(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint

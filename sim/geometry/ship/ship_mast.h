// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Enclosed forward mast with its pole, lattice mast amidships, radars and antennas.

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/ship/ship_hull.h"
#include "sim/geometry/ship/ship_superstructure.h"

namespace seaglint {

void add_masts(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint

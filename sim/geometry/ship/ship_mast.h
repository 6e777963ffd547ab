// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The enclosed forward mast with its pole, the lattice mast amidships, radars and aerials.

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/ship/ship_hull.h"
#include "sim/geometry/ship/ship_superstructure.h"

namespace seaglint {

void add_masts(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rails of posts and bars, ladders, and the nets around the flight deck.

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/ship/ship_hull.h"
#include "sim/geometry/ship/ship_superstructure.h"

namespace seaglint {

void add_rails(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint

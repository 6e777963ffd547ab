// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Fittings on the decks: bitts, fairleads, windlasses, lockers, ventilators, splinter shields, boats and their bays.

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/ship/ship_hull.h"
#include "sim/geometry/ship/ship_superstructure.h"

namespace seaglint {

void add_deck_fittings(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint

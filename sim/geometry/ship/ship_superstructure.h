// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Deckhouses, bridge with wings, funnel, hangar.
// Positions are given on the 144 m design and scaled by HullSurface.

#include <string>

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/shapes/solids.h"
#include "sim/geometry/ship/ship_hull.h"

namespace seaglint {

// A deckhouse: a frustum on an octagon, its walls inclined inwards. Heights above the waterline; wall slopes from the
// vertical in degrees.
struct Deckhouse {
  std::string name;
  double aft = 0, fore = 0;   // at the foot, design metres
  double half_width = 0;      // at the foot, design metres
  double foot = 0, roof = 0;  // m above the waterline
  double side_slope = 8, fore_slope = 12, aft_slope = 6;
  double fore_chamfer = 2.5, aft_chamfer = 0.8;  // chamfer of the vertical edges, m

  double half_width_at(const HullSurface& hull, double z) const;
  double fore_at(const HullSurface& hull, double z) const;
  double aft_at(const HullSurface& hull, double z) const;

  // Pose on the side wall at design x and height z: +x is the outward normal, +z points up along the wall. side = +1
  // port, -1 starboard.
  Pose on_side(const HullSurface& hull, double side, double design_x, double z) const;
};

// The houses that carry all fittings.
struct ShipHouses {
  Deckhouse forward, bridge, flag_deck, core, aft, radar_house;
};
ShipHouses ship_houses(const HullSurface& hull);

void add_superstructure(MeshBuilder& builder, const HullSurface& hull, const ShipHouses& houses);

}  // namespace seaglint
